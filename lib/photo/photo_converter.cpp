// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_converter.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/strutil.h>
#include <srisp/metadata.h>

#include "photo/color_channels.h"
#include "photo/color_management.h"

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

/// What the names that OpenImageIO, OpenColorIO configurations and cameras use say of the encoding.
enum class NamedSpace { unknown, srgb, linear };
NamedSpace named_space(const std::string& name)
{
    for (const char* srgb : { "sRGB", "Gamma2.2", "GammaCorrected", "GammaCorrected2.2", "g22_rec709", "srgb_texture",
                              "out_srgb", "Utility - sRGB - Texture", "sRGB - Texture", "sRGB Encoded Rec.709 (sRGB)" })
        if (Strutil::iequals(name, srgb))
            return NamedSpace::srgb;
    for (const char* linear : { "Linear", "lin_srgb", "lin_rec709", "scene_linear", "Utility - Linear - sRGB",
                                "Linear Rec.709 (sRGB)", "linear - sRGB", "rendering" })
        if (Strutil::iequals(name, linear))
            return NamedSpace::linear;
    return NamedSpace::unknown;
}

/// What to do with colour values.
struct Decoding {
    bool linear = false; ///< encode with the sRGB curve
    std::shared_ptr<const ColorTransform> transform;
    std::vector<std::string> notes;
};

Expected<Decoding> decide_automatically(const OIIO::ImageSpec& spec, int channels, const std::string& where)
{
    Decoding decoding;
    if (is_unprocessed(spec))
        return Error{ where + ": is a RAW-like image already (srisp made it); input=srgb takes it for a photo" };
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    const NamedSpace named = named_space(space);
    const OIIO::ParamValue* icc = spec.find_attribute("ICCProfile");
    if (named == NamedSpace::linear) {
        decoding.linear = true;
        // A program that made the image linear kept the profile of what it was before.
        if (icc)
            decoding.notes.push_back("the ICC profile was ignored, since the image says that it is linear");
        return decoding;
    }
    if (icc) {
        auto transform = color_transform_from_icc(icc->data(), icc->type().size(), channels);
        if (!transform)
            return Error{ where + ": " + transform.error().message + "; input=srgb ignores it" };
        decoding.transform = *transform;
        return decoding;
    }
    decoding.linear = named == NamedSpace::unknown && spec.format.is_floating_point();
    const char* taken_as = decoding.linear ? "linear sRGB" : "display-encoded sRGB";
    if (named == NamedSpace::unknown && !space.empty())
        decoding.notes.push_back("the colour space '" + space + "' is not known; taken as " + taken_as);
    // EXIF says "uncalibrated" for Adobe RGB, and OpenImageIO does not show the interoperability index that tells.
    if (spec.get_int_attribute("Exif:ColorSpace", 1) == 65535)
        decoding.notes.push_back(
            "EXIF says that the colour space is not sRGB, and no ICC profile tells which; taken as "
            "display-encoded sRGB");
    return decoding;
}

OIIO::ImageSpec make_output_spec(const OIIO::ImageSpec& photo, const ColorChannels& channels)
{
    OIIO::ImageSpec spec = photo;
    spec.set_format(OIIO::TypeFloat);
    spec.channelformats.clear();
    spec.channelnames = { "R", "G", "B" };
    spec.alpha_channel = channels.alpha >= 0 ? 3 : -1;
    if (channels.alpha >= 0)
        spec.channelnames.push_back("A");
    spec.z_channel = -1;
    for (const int c : channels.others) {
        if (c == photo.z_channel)
            spec.z_channel = static_cast<int>(spec.channelnames.size());
        spec.channelnames.push_back(photo.channel_name(c));
    }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    return spec;
}

/// Into [0,1]; what is not a number becomes 0.
void bound_values(const float* in, std::int64_t count, float* out, PhotoCounts& counts)
{
    constexpr std::int64_t block = 1024; // counted in ints, which vectorise
    for (std::int64_t first = 0; first < count; first += block) {
        const std::int64_t last = std::min(first + block, count);
        int replaced = 0, clipped = 0;
        for (std::int64_t i = first; i < last; ++i) {
            const float value = in[i];
            replaced += value != value;
            // Rounding of 8-bit associated colour is no clipping.
            clipped += (value < -0.002f) | (value > 1.002f);
            const float above = value > 0 ? value : 0; // NaN, too
            out[i] = above < 1 ? above : 1;
        }
        counts.replaced += replaced;
        counts.clipped += clipped;
    }
    counts.values += count;
}

} // namespace

PhotoCounts& PhotoCounts::operator+=(const PhotoCounts& other)
{
    values += other.values;
    clipped += other.clipped;
    replaced += other.replaced;
    return *this;
}

std::vector<std::string> PhotoCounts::notes() const
{
    std::vector<std::string> notes;
    const std::string of_all = " of " + std::to_string(values) + " colour values ";
    if (clipped)
        notes.push_back(std::to_string(clipped) + of_all + "lay outside sRGB's 0 to 1 and were clipped");
    if (replaced)
        notes.push_back(std::to_string(replaced) + of_all + "were not numbers and became 0");
    return notes;
}

struct PhotoConverter::State {
    ColorChannels channels;
    int stored_channels = 0;
    bool straight = false; ///< stored colour is not multiplied by alpha
    bool linear = false;
    std::shared_ptr<const ColorTransform> transform;
    OIIO::ImageSpec output_spec;
    std::vector<std::string> notes;

    float alpha(const float* pixel) const
    {
        const float alpha = channels.alpha >= 0 ? pixel[channels.alpha] : 1;
        return std::isfinite(alpha) ? alpha : 1;
    }
    bool is_black(const float* pixel) const
    {
        for (const int c : channels.color)
            if (pixel[c] != 0)
                return false;
        return true;
    }
    /// Whether pixels are stored as they are wanted.
    bool is_plain_rgb() const { return stored_channels == 3 && channels.color == std::vector{ 0, 1, 2 }; }
    /// Three values of each pixel, not multiplied by alpha any more.
    void pick_colors(const float* stored, std::int64_t pixels, float* rgb) const
    {
        const std::vector<int>& color = channels.color;
        for (std::int64_t i = 0; i < pixels; ++i, stored += stored_channels) {
            const float opacity = straight ? 1 : alpha(stored);
            const float scale = opacity > 0 ? 1 / opacity : 1;
            for (int c = 0; c < 3; ++c)
                *rgb++ = stored[color[color.size() == 3 ? c : 0]] * scale;
        }
    }
};

PhotoConverter::PhotoConverter(std::unique_ptr<const State> state) : m_state(std::move(state)) {}
PhotoConverter::~PhotoConverter() = default;
PhotoConverter::PhotoConverter(PhotoConverter&&) noexcept = default;
PhotoConverter& PhotoConverter::operator=(PhotoConverter&&) noexcept = default;

Expected<PhotoConverter> PhotoConverter::create(const OIIO::ImageSpec& spec, InputEncoding encoding,
                                                const std::string& where)
{
    if (spec.deep)
        return Error{ where + ": is a deep image; flatten it first" };
    if (spec.depth > 1)
        return Error{ where + ": is a volume of " + std::to_string(spec.depth) + " slices; a photo has one" };
    auto channels = find_color_channels(spec, where);
    if (!channels)
        return channels.error();
    auto state = std::make_unique<State>();
    if (encoding == InputEncoding::automatic) {
        auto decoding = decide_automatically(spec, static_cast<int>(channels->color.size()), where);
        if (!decoding)
            return decoding.error();
        state->linear = decoding->linear;
        state->transform = decoding->transform;
        state->notes = decoding->notes;
    } else {
        state->linear = encoding == InputEncoding::linear;
    }
    state->channels = *channels;
    state->stored_channels = spec.nchannels;
    state->straight = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
    state->output_spec = make_output_spec(spec, *channels);
    return PhotoConverter(std::move(state));
}

const OIIO::ImageSpec& PhotoConverter::output_spec() const
{
    return m_state->output_spec;
}
const std::vector<std::string>& PhotoConverter::notes() const
{
    return m_state->notes;
}

void PhotoConverter::to_rgb(const float* stored, std::int64_t pixels, float* rgb, PhotoCounts& counts) const
{
    const State& state = *m_state;
    if (state.is_plain_rgb())
        bound_values(stored, pixels * 3, rgb, counts);
    else {
        state.pick_colors(stored, pixels, rgb);
        bound_values(rgb, pixels * 3, rgb, counts);
    }
    if (state.linear)
        std::transform(rgb, rgb + pixels * 3, rgb, srgb_encoded);
    if (state.transform)
        counts.clipped += state.transform->apply(rgb, pixels);
}

void PhotoConverter::from_rgb(const float* rgb, const float* stored, std::int64_t pixels, bool associate,
                              float* out) const
{
    const State& state = *m_state;
    for (std::int64_t i = 0; i < pixels; ++i) {
        const float* in = stored + i * state.stored_channels;
        float alpha = std::max(state.alpha(in), 0.0f);
        // Colour where nothing is opaque is light that is added (fire): it is kept.
        if (!state.straight && alpha <= 0 && !state.is_black(in))
            alpha = 1;
        for (int c = 0; c < 3; ++c)
            *out++ = rgb[i * 3 + c] * (associate ? alpha : 1);
        if (state.channels.alpha >= 0)
            *out++ = in[state.channels.alpha];
        for (const int c : state.channels.others)
            *out++ = in[c];
    }
}

} // namespace srisp
