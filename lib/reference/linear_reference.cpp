// SPDX-License-Identifier: Apache-2.0
#include "reference/decoders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <srisp/metadata.h>
#include <srisp/thumbnail.h>

#include "base/shown_reason.h"
#include "base/shown_text.h"
#include "container/image_limits.h"
#include "container/size_in_header.h"
#include "record/record.h"

namespace srisp {

namespace {

constexpr std::uint64_t kMostBandBytes = std::uint64_t(1) << 30;

/// Whether this image can be a reference.
Status check_kind(const OIIO::ImageSpec& spec, bool tiff)
{
    if (Status status = check_no_mosaic(spec); !status)
        return status;
    const std::string encoding = spec.get_string_attribute("oiio:ColorSpace");
    const bool processed = !spec.get_string_attribute(attribute::kSynthetic).empty();
    if (!recorded_development(spec).empty())
        return Error{ "is developed into " + shown_text(recorded_space(spec)) +
                      " and cannot be a reference: give the RAW-like image, or a RAW file" };
    if (is_unprocessed(spec)) {
        if (tiff && spec.format != OIIO::TypeUInt16 && !spec.format.is_floating_point())
            return Error{ std::string("TIFF of ") + spec.format.c_str() + " values: 16 bits or float are needed" };
    } else if (processed) {
        return Error{
            "is what srisp made of a RAW-like image, display-encoded and cannot be a reference: give a RAW file"
        };
    } else if (tiff) {
        return Error{ "TIFF without srisp's metadata may be display-encoded and cannot be a reference: give a RAW "
                      "file, or an EXR or TIFF that srisp wrote" };
    } else if (OIIO::Strutil::istarts_with(encoding, "sRGB") || OIIO::Strutil::istarts_with(encoding, "Rec709") ||
               OIIO::Strutil::istarts_with(encoding, "Gamma")) {
        return Error{ "is display-encoded (colour space '" + shown_text(encoding) +
                      "') and cannot be a reference: give a RAW file" };
    }
    if (spec.deep)
        return Error{ "deep image: not supported" };
    if (!tiff && !spec.format.is_floating_point())
        return Error{ std::string("EXR of ") + spec.format.c_str() + " values: half or float are needed" };
    if (spec.depth > 1)
        return Error{ "volume of " + std::to_string(spec.depth) + " planes: not supported" };
    return {};
}

/// Channel numbers of R, G and B; empty if one is missing.
std::vector<int> rgb_channels(const OIIO::ImageSpec& spec)
{
    std::vector<int> channels;
    for (const char* name : { "R", "G", "B" }) {
        const auto found = std::find_if(spec.channelnames.begin(), spec.channelnames.end(),
                                        [&](const std::string& n) { return OIIO::Strutil::iequals(n, name); });
        if (found != spec.channelnames.end())
            channels.push_back(int(found - spec.channelnames.begin()));
    }
    return channels.size() == 3 ? channels : std::vector<int>();
}

/// Feeds the rows of an open image to a ThumbnailBuilder.
class RowReader {
public:
    RowReader(OIIO::ImageInput& input, const std::vector<int>& channels)
        : m_input(input), m_spec(input.spec()), m_channels(channels),
          m_first(*std::min_element(channels.begin(), channels.end())),
          m_count(*std::max_element(channels.begin(), channels.end()) + 1 - m_first),
          m_builder(m_spec.width, m_spec.height)
    {
    }

    Status read_all()
    {
        const int band = m_spec.tile_height > 0 ? m_spec.tile_height : 32;
        const std::uint64_t values = std::uint64_t(m_spec.width) * std::uint64_t(band) * std::uint64_t(m_count);
        if (values * sizeof(float) > kMostBandBytes)
            return Error{ "tiles of " + std::to_string(m_spec.tile_width) + " x " + std::to_string(band) +
                          " pixels are too large" };
        m_stored.resize(std::size_t(values));
        m_rgb.resize(std::size_t(m_spec.width) * 3);
        for (int y = 0; y < m_spec.height; y += band)
            if (Status status = read_band(y, std::min(y + band, m_spec.height)); !status)
                return status;
        return {};
    }

    const ThumbnailBuilder& builder() const { return m_builder; }
    std::uint64_t clipped() const { return m_clipped; }

private:
    Status read_band(int begin, int end)
    {
        const int x = m_spec.x, y = m_spec.y;
        const bool read = m_spec.tile_height > 0
                              ? m_input.read_tiles(0, 0, x, x + m_spec.width, y + begin, y + end, 0, 1, m_first,
                                                   m_first + m_count, OIIO::TypeFloat, m_stored.data())
                              : m_input.read_scanlines(0, 0, y + begin, y + end, 0, m_first, m_first + m_count,
                                                       OIIO::TypeFloat, m_stored.data());
        if (!read)
            return Error{ "damaged or truncated at row " + std::to_string(begin) + ": " +
                          shown_reason(m_input.geterror()) };
        for (int row = begin; row < end; ++row)
            if (Status status = add_row(row, m_stored.data() + std::size_t(row - begin) * row_values()); !status)
                return status;
        return {};
    }

    Status add_row(int row, const float* stored)
    {
        for (int x = 0; x < m_spec.width; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                const float value = stored[x * m_count + m_channels[c] - m_first];
                if (!std::isfinite(value))
                    return Error{ "NaN or infinity at pixel (" + std::to_string(x) + ", " + std::to_string(row) + ")" };
                const float kept = std::clamp(value, 0.0f, 1.0f);
                m_clipped += kept != value;
                m_rgb[std::size_t(x) * 3 + c] = kept;
            }
        m_builder.add_rows({ m_rgb.data(), m_spec.width, 1, 3, std::ptrdiff_t(m_spec.width) * 3 });
        return {};
    }

    std::size_t row_values() const { return std::size_t(m_spec.width) * std::size_t(m_count); }

    OIIO::ImageInput& m_input;
    const OIIO::ImageSpec m_spec;
    const std::vector<int> m_channels;
    const int m_first, m_count; // the range of stored channels that holds R, G and B
    ThumbnailBuilder m_builder;
    std::vector<float> m_stored, m_rgb;
    std::uint64_t m_clipped = 0;
};

/// What an image says of itself and, where srisp made it, of the camera that it imitates.
CameraFacts facts_of(const OIIO::ImageSpec& spec)
{
    CameraFacts facts = recorded_camera(spec);
    facts.noise_profile = recorded_sensor(spec).noise_profile; // of values in [0,1], whatever the levels were
    facts.width = spec.width;
    facts.height = spec.height;
    const int orientation = spec.get_int_attribute("Orientation", 1);
    facts.orientation = orientation >= 1 && orientation <= 8 ? orientation : 1;
    facts.white_level = 1;
    return facts;
}

} // namespace

Status check_no_mosaic(const OIIO::ImageSpec& spec)
{
    const std::string filters = recorded_sensor_values(spec).cfa_pattern;
    if (filters.empty())
        return {};
    return Error{ "is a mosaic (" + shown_text(filters) +
                  ") that srisp wrote as an image; write it as a DNG, which can be a reference" };
}

Expected<LinearReference> read_linear_reference(const std::string& path, const std::string& format)
{
    // By the format's name: OpenImageIO would offer a damaged file to every plugin under a lock, ours among them.
    const auto input = OIIO::ImageInput::create(format);
    if (!input)
        return Error{ "OpenImageIO has no reader for " + format };
    if (Status status = check_header(format, path); !status)
        return status.error();
    OIIO::ImageSpec spec;
    if (!input->open(path, spec))
        return Error{ "can't be opened as " + format + ": " + shown_reason(input->geterror()) };
    if (Status status = check_size(spec); !status)
        return status.error();
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
    if (Status status =
            check_claim(format.c_str(), std::uint64_t(spec.width), std::uint64_t(spec.height), unknown ? 0 : bytes);
        !status)
        return status.error();
    if (Status status = check_kind(spec, format == "tiff"); !status)
        return status.error();
    const std::vector<int> channels = rgb_channels(spec);
    if (channels.empty())
        return Error{ "image without channels R, G, B (it has " +
                      shown_text(OIIO::Strutil::join(spec.channelnames, ", ")) + ")" };

    RowReader reader(*input, channels);
    if (Status status = reader.read_all(); !status)
        return status.error();
    LinearReference image{ {}, facts_of(spec), {} };
    image.thumbnail = reader.builder().finish(image.facts.orientation);
    if (!is_unprocessed(spec))
        image.notes.push_back("taken as linear camera RGB in [0,1]: the EXR does not say what it is");
    if (reader.clipped() > 0)
        image.notes.push_back(std::to_string(reader.clipped()) + " values outside [0,1] were clipped");
    return image;
}

} // namespace srisp
