// SPDX-License-Identifier: Apache-2.0
#include "dng_samples.h"

#include <algorithm>
#include <cmath>

#include <srisp/metadata.h>

#include "base/parallel.h"
#include "base/shown_text.h"
#include "color/color_reading.h"

namespace srisp::plugin {

namespace {

constexpr float kMostCode = 65535;

/// What a RAW-like image says of itself, or a user of his own.
bool is_raw_like(const OIIO::ImageSpec& spec)
{
    const auto record = read_record(spec);
    return (record && record->direction == Direction::reverse) || !recorded_camera(spec).color_matrices.empty() ||
           spec.get_string_attribute("oiio:ColorSpace") == kCameraColorSpace ||
           spec.get_string_attribute(attribute::kColorSpace) == kCameraColorSpace;
}

} // namespace

DngSamples::DngSamples(const OIIO::ImageSpec& spec, const DngSettings& settings)
    : m_width(spec.width), m_height(spec.height), m_channels(spec.nchannels), m_settings(settings),
      m_facts(recorded_sensor(spec)), m_done(std::size_t(spec.height)), m_missing(spec.height)
{
    m_facts.orientation = spec.get_int_attribute("Orientation", 1);
    m_facts.noise_profile = recorded_sensor_values(spec).noise_profile;
}

Expected<DngSamples> DngSamples::create(const OIIO::ImageSpec& spec, const DngSettings& settings)
{
    if (!recorded_development(spec).empty())
        return Error{ "image that is developed into " + shown_text(recorded_space(spec)) + ": a DNG holds camera RGB" };
    DngSamples samples(spec, settings);
    if (spec.nchannels != 1 && spec.nchannels != 3)
        return Error{ "image of " + std::to_string(spec.nchannels) +
                      " channels: a DNG has 1 (a mosaic) or 3 (R, G, B; --ch R,G,B leaves others out)" };
    if (settings.floats && spec.nchannels == 1)
        return Error{ "a mosaic has integers; half and float are for three channels" };
    const Status set = spec.nchannels == 1 ? samples.set_mosaic(spec) : samples.set_colors(spec);
    if (!set)
        return set.error();
    const std::size_t count = std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels);
    if (settings.floats)
        samples.m_floats.resize(count);
    else
        samples.m_shorts.resize(count);
    return samples;
}

Status DngSamples::set_mosaic(const OIIO::ImageSpec& spec)
{
    const SensorValues values = recorded_sensor_values(spec);
    if (values.cfa_pattern.empty())
        return Error{ std::string("image of one channel: the attribute '") + attribute::kCfaPattern +
                      "' must say which filters lie over it, RGGB, GRBG, GBRG or BGGR" };
    const auto phase = parse_bayer_phase(values.cfa_pattern);
    if (!phase)
        return phase.error();
    m_phase = MosaicPlace{ *phase, spec.x, spec.y }.phase_here();
    // An image in a camera's codes that lacks that camera's facts, as files keep few attributes.
    if (m_facts.white_level <= 0 && values.has_levels()) {
        m_facts.white_level = values.white_code();
        for (std::size_t i = 0; i < 4; ++i)
            m_facts.black_level[i] = values.black_code(i);
    }
    // The reference's codes, unless it has none, or they need more bits than are wanted.
    const float most = float((1 << m_settings.options.bits) - 1);
    const bool codes = m_facts.has_integer_levels();
    const float scale = codes ? std::min(most / m_facts.white_level, 1.0f) : 1;
    m_white = codes ? std::round(m_facts.white_level * scale) : most;
    if (scale < 1)
        m_notes.push_back("the reference's codes up to " + shown_number(m_facts.white_level) + " were scaled to " +
                          std::to_string(m_settings.options.bits) + " bits");
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            const std::size_t which = bayer_level(*phase, spec.x + x, spec.y + y);
            Level& level = m_levels[std::size_t(y * 2 + x)];
            level.from = values.black_level[which];
            level.scale = 1 / (values.white_level - level.from);
            level.black = codes ? m_facts.black_level[which] * scale : 0;
            level.range = m_white - level.black;
            if (!(std::isfinite(level.scale) && level.scale > 0 && level.range > 0 && level.black >= 0))
                return Error{ "black level " + shown_number(level.from) + " is not below white level " +
                              shown_number(values.white_level) };
        }
    return {};
}

Status DngSamples::set_colors(const OIIO::ImageSpec& spec)
{
    if (!is_raw_like(spec))
        take_photo(spec);
    if (m_settings.floats)
        return {};
    // Black above 0 is read wrongly by darktable 4.2 and RawTherapee 5.9.
    m_white = float((1 << m_settings.options.bits) - 1);
    for (Level& level : m_levels)
        level.range = m_white;
    return {};
}

/// A picture that was never unprocessed: linear light, as it would come from a camera that sees as sRGB does.
void DngSamples::take_photo(const OIIO::ImageSpec& spec)
{
    ColorReading reading = read_as_described(spec, 3);
    m_to_srgb = reading.transform;
    m_is_photo = true;
    m_notes.push_back(
        "the image was never unprocessed: its colours were taken for light that a neutral camera saw, with "
        "sRGB's primaries, white balanced");
    m_notes.insert(m_notes.end(), reading.notes.begin(), reading.notes.end());
    m_facts.as_shot_neutral = { 1, 1, 1 };
    CameraFacts::ColorMatrix matrix;
    const Matrix3 xyz_to_srgb = inverse(kSrgbToXyz);
    std::copy(xyz_to_srgb.begin(), xyz_to_srgb.end(), matrix.xyz_to_camera.begin());
    constexpr int kD65 = 21;
    matrix.illuminant = kD65;
    m_facts.color_matrices = { matrix };
}

Status DngSamples::put(int row, const float* values)
{
    const std::size_t count = std::size_t(m_width) * std::size_t(m_channels);
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(values[i]))
            return Error{ "value " + shown_number(values[i]) + " of pixel (" +
                          std::to_string(i / std::size_t(m_channels)) + ", " + std::to_string(row) +
                          "): a DNG needs finite ones" };
    std::vector<float> light;
    if (m_is_photo) {
        light.assign(values, values + count);
        if (m_to_srgb && !m_to_srgb->takes_unbounded())
            for (float& value : light)
                m_clipped += clip(value);
        if (m_to_srgb)
            m_clipped += m_to_srgb->apply(light.data(), m_width);
        for (float& value : light)
            value = srgb_decoded(std::clamp(value, 0.0f, 1.0f));
        values = light.data();
    }
    const std::size_t first = count * std::size_t(row);
    if (m_settings.floats) {
        std::copy_n(values, count, m_floats.begin() + std::ptrdiff_t(first));
    } else {
        for (std::size_t i = 0; i < count; ++i) {
            const int x = int(i) / m_channels;
            const Level& level = m_levels[level_of(x, row, int(i) % m_channels)];
            const float code = level.black + (values[i] - level.from) * level.scale * level.range;
            const float bounded = std::clamp(code, 0.0f, m_white);
            m_clipped += std::abs(code - bounded) > 0.5f;
            m_shorts[first + i] = std::uint16_t(std::lround(bounded));
        }
    }
    m_missing -= !m_done[std::size_t(row)];
    m_done[std::size_t(row)] = true;
    return {};
}

std::size_t DngSamples::level_of(int x, int y, int channel) const
{
    return std::size_t(m_channels == 1 ? (y & 1) * 2 + (x & 1) : channel);
}

DngImage DngSamples::image() const
{
    DngImage image;
    image.width = m_width;
    image.height = m_height;
    image.planes = m_channels;
    image.shorts = m_settings.floats ? nullptr : m_shorts.data();
    image.floats = m_settings.floats ? m_floats.data() : nullptr;
    image.row_stride = std::ptrdiff_t(m_width) * m_channels;
    image.facts = m_facts;
    if (!m_settings.floats)
        image.white.fill(std::uint32_t(m_white));
    if (m_channels == 1) {
        image.cfa_pattern = bayer_phase_text(m_phase);
        image.black_rows = image.black_columns = 2;
        for (const Level& level : m_levels)
            image.black.push_back(level.black);
    }
    return image;
}

/// Of [0,1], where 0 is black.
float DngSamples::value_of(int x, int y, int channel) const
{
    const std::size_t i =
        (std::size_t(y) * std::size_t(m_width) + std::size_t(x)) * std::size_t(m_channels) + std::size_t(channel);
    if (m_settings.floats)
        return m_floats[i];
    const Level& level = m_levels[level_of(x, y, channel)];
    return (m_shorts[i] - level.black) / level.range;
}

DngSamples::Picture DngSamples::picture(int most) const
{
    // Cells of whole Bayer patterns: each holds all colours.
    const int step = m_channels == 1 ? 2 : 1;
    const int cell = step * std::max(1, (std::max(m_width, m_height) + most * step - 1) / (most * step));
    Picture picture;
    picture.width = m_width / cell;
    picture.height = m_height / cell;
    picture.rgb.resize(std::size_t(picture.width) * std::size_t(picture.height) * 3);
    parallel_tasks(picture.height, 0, [&](std::int64_t row) {
        for (int column = 0; column < picture.width; ++column) {
            float sums[3] = {}, counts[3] = {};
            for (int y = int(row) * cell; y < (int(row) + 1) * cell; ++y)
                for (int x = column * cell; x < (column + 1) * cell; ++x)
                    for (int c = 0; c < m_channels; ++c) {
                        const int color = m_channels == 1 ? bayer_color(m_phase, x, y) : c;
                        sums[color] += value_of(x, y, c);
                        counts[color] += 1;
                    }
            for (int c = 0; c < 3; ++c)
                picture
                    .rgb[(std::size_t(row) * std::size_t(picture.width) + std::size_t(column)) * 3 + std::size_t(c)] =
                    std::clamp(sums[c] / counts[c], 0.0f, 1.0f);
        }
    });
    return picture;
}

std::vector<std::string> DngSamples::notes() const
{
    std::vector<std::string> notes = m_notes;
    if (m_clipped > 0)
        notes.push_back(std::to_string(m_clipped) + " of " +
                        std::to_string(std::int64_t(m_width) * m_height * m_channels) +
                        " values lay outside what the file's levels hold, and were clipped");
    return notes;
}

} // namespace srisp::plugin
