// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_converter.h"

#include <algorithm>
#include <cmath>

#include <srisp/metadata.h>

#include "color/color_reading.h"
#include "container/file_description.h"
#include "develop/undo_matrix.h"
#include "photo/code_values.h"
#include "photo/color_channels.h"
#include "record/record.h"

namespace srisp {

namespace {

ColorReading reading_of(const OIIO::ImageSpec& spec, InputEncoding encoding, int channels)
{
    switch (encoding) {
    case InputEncoding::automatic:
        return read_as_described(spec, channels);
    case InputEncoding::linear:
        return read_as_linear();
    case InputEncoding::srgb:
    case InputEncoding::camera:
        break;
    }
    return read_as_srgb();
}

OIIO::ImageSpec make_output_spec(const OIIO::ImageSpec& photo, const ColorChannels& channels)
{
    OIIO::ImageSpec spec = photo;
    erase_notes(spec);
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

/// What is not a number becomes 0, and infinity as much as fits any arithmetic.
void make_finite(const float* in, std::int64_t count, float* out, PhotoCounts& counts)
{
    constexpr float most = 1e6f;
    for (std::int64_t i = 0; i < count; ++i) {
        const float value = in[i];
        counts.replaced += value != value;
        const float number = value == value ? value : 0;
        out[i] = number < most ? (number > -most ? number : -most) : most;
    }
    counts.values += count;
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
    bool integers = false; ///< from 0 to 1 as floats
    ColorTransformPtr transform;
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
    if (!recorded_sensor_values(spec).cfa_pattern.empty())
        return Error{ where + ": is a mosaic, as a sensor gives it; a DNG of it is demosaiced when it is read" };
    auto channels = find_color_channels(spec, where);
    if (!channels)
        return channels.error();
    auto state = std::make_unique<State>();
    if (encoding == InputEncoding::automatic && is_unprocessed(spec))
        return Error{ where + ": is a RAW-like image already (srisp made it); input=srgb takes it for a photo" };
    ColorReading reading = reading_of(spec, encoding, static_cast<int>(channels->color.size()));
    if (const std::string recorded = recorded_development(spec);
        encoding == InputEncoding::camera && !recorded.empty()) {
        const auto development = development_from_json(recorded, where);
        if (!development)
            return development.error();
        reading.transform = plain_matrix(undo_matrix(*development));
    }
    state->transform = std::move(reading.transform);
    state->notes = note_list(spec);
    state->notes.insert(state->notes.end(), reading.notes.begin(), reading.notes.end());
    state->channels = *channels;
    state->stored_channels = spec.nchannels;
    state->integers = spec.channelformats.empty() && are_codes(spec.format);
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

bool PhotoConverter::is_rgb_alone() const
{
    return m_state->is_plain_rgb() && m_state->channels.alpha < 0;
}

void PhotoConverter::to_rgb(const float* stored, std::int64_t pixels, float* rgb, PhotoCounts& counts) const
{
    const State& state = *m_state;
    const float* picked = stored;
    if (!state.is_plain_rgb()) {
        state.pick_colors(stored, pixels, rgb);
        picked = rgb;
    }
    const bool unbounded = state.transform && state.transform->takes_unbounded();
    if (picked == rgb && state.is_plain_rgb() && state.integers)
        counts.values += pixels * 3; // in bounds as they are
    else
        (unbounded ? make_finite : bound_values)(picked, pixels * 3, rgb, counts);
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
