// SPDX-License-Identifier: Apache-2.0
#include "gain_map/gain_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace srisp {

namespace {

// Steps are even in the square root of the map's value: v^(1/gamma), whose slope has no bound at 0 for the usual gammas
// above 1, is nearly straight in it. Between steps, factors are right to 1e-5 (4 stops and a gamma of 2.2 at most).
constexpr int kSteps = 4096;
constexpr float kLargestValue = 255;

bool is_same_in_all_channels(const GainMapMetadata& metadata)
{
    const auto is_same = [](const std::array<double, 3>& rgb) { return rgb[0] == rgb[1] && rgb[1] == rgb[2]; };
    return is_same(metadata.min) && is_same(metadata.max) && is_same(metadata.gamma) && is_same(metadata.offset_sdr) &&
           is_same(metadata.offset_hdr);
}

float mixed(float first, float second, float weight)
{
    return first + weight * (second - first);
}

} // namespace

GainMap::Boost::Boost(const GainMapMetadata& metadata, std::size_t channel)
    : factors(kSteps + 1), offset_sdr(float(metadata.offset_sdr[channel])),
      offset_hdr(float(metadata.offset_hdr[channel]))
{
    for (int i = 0; i <= kSteps; ++i) {
        const double recovery = std::pow(double(i) / kSteps, 2 / metadata.gamma[channel]);
        factors[std::size_t(i)] =
            float(std::exp2(metadata.min[channel] + (metadata.max[channel] - metadata.min[channel]) * recovery));
    }
}

float GainMap::Boost::factor(float value) const
{
    const float position = std::sqrt(value * (float(kSteps) * kSteps / kLargestValue));
    const int index = std::min(int(position), kSteps - 1);
    return mixed(factors[std::size_t(index)], factors[std::size_t(index) + 1], position - float(index));
}

std::vector<GainMap::Position> GainMap::positions(int pixels, int map_pixels)
{
    std::vector<Position> result;
    result.reserve(std::size_t(pixels));
    for (int i = 0; i < pixels; ++i) {
        const double centre = (i + 0.5) * map_pixels / pixels - 0.5;
        const double at = std::min(std::max(centre, 0.0), map_pixels - 1.0);
        const int first = int(at);
        result.push_back({ first, std::min(first + 1, map_pixels - 1), float(at - first) });
    }
    return result;
}

GainMap::GainMap(GainMapImage image, const GainMapMetadata& metadata, int width, int height)
    : m_image(std::move(image)), m_columns(positions(width, m_image.width)),
      m_rows(positions(height, m_image.height)), m_boosts{ Boost(metadata, 0), Boost(metadata, 1), Boost(metadata, 2) },
      m_one_factor(m_image.channels == 1 && is_same_in_all_channels(metadata))
{
    // Indices of values, not of pixels.
    for (Position& column : m_columns) {
        column.first *= m_image.channels;
        column.second *= m_image.channels;
    }
}

Expected<GainMap> GainMap::create(const GainMapInfo& info, int width, int height)
{
    if (info.kind == GainMapInfo::Kind::apple)
        return Error{ "its gain map is of Apple's own kind, which this program cannot apply" };
    if (info.metadata.base_is_hdr)
        return Error{ "its gain map leads from HDR to SDR: the base is HDR already" };
    if (width < 1 || height < 1)
        return Error{ "its gain map is for a photo of " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels" };
    auto image = decode_gain_map_image(info.jpeg);
    if (!image)
        return image.error();
    // One factor for all channels, with one offset, is the same in any primaries.
    if (!info.metadata.in_colors_of_base && (image->channels == 3 || !is_same_in_all_channels(info.metadata)))
        return Error{ "its gain map counts in other primaries than the photo's, which this program cannot apply" };
    return GainMap(std::move(*image), info.metadata, width, height);
}

void GainMap::boosted(int y, const float* sdr, float* hdr) const
{
    const Position& row = m_rows[std::size_t(y)];
    const unsigned char* first = m_image.row(row.first);
    const unsigned char* second = m_image.row(row.second);
    std::vector<float> values(std::size_t(m_image.width) * std::size_t(m_image.channels));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = mixed(first[i], second[i], row.weight);

    const auto value_at = [&](const Position& column, int channel) {
        return mixed(values[std::size_t(column.first + channel)], values[std::size_t(column.second + channel)],
                     column.weight);
    };
    for (const Position& column : m_columns) {
        float value = value_at(column, 0);
        float factor = m_boosts[0].factor(value);
        for (int c = 0; c < 3; ++c) {
            const Boost& boost = m_boosts[std::size_t(c)];
            if (!m_one_factor)
                factor = boost.factor(m_image.channels == 1 ? value : value_at(column, c));
            hdr[c] = boost.applied(sdr[c], factor);
        }
        sdr += 3;
        hdr += 3;
    }
}

} // namespace srisp
