// SPDX-License-Identifier: Apache-2.0
#include "reference/raw_pixels.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/shown_text.h"

namespace srisp {

namespace {

float largest(const std::vector<float>& values)
{
    return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

} // namespace

Status check_filters(const RawPixels& pixels)
{
    const CfaPattern& cfa = pixels.cfa;
    if (pixels.channels == 3)
        return {};
    if (cfa.letters.find_first_not_of("RGB") != std::string::npos)
        return Error{ "filters of colours other than R, G, B (" + cfa.letters + "): not supported" };
    for (const char letter : { 'R', 'G', 'B' })
        if (cfa.letters.find(letter) == std::string::npos)
            return Error{ "filters without one for each of R, G, B (" + cfa.letters + "): not supported" };
    // Every cell of the thumbnail must hold sites of all colours; smaller Bayer sensors are demosaiced instead.
    const int smallest = cfa.rows == 2 ? 2 : kThumbnailSize * cfa.rows / 2;
    if (std::min(pixels.width, pixels.height) < smallest)
        return Error{ "sensor of " + std::to_string(pixels.width) + " x " + std::to_string(pixels.height) +
                      " pixels: at least " + std::to_string(smallest) + " a side are needed for its filters" };
    return {};
}

Status check_levels(const RawPixels& pixels)
{
    const BlackLevels& black = pixels.black;
    for (const auto* values : { &black.pattern, &black.by_column, &black.by_row })
        if (std::any_of(values->begin(), values->end(), [](float v) { return !std::isfinite(v); }))
            return Error{ "a black level is not a finite number" };
    const auto channels = std::size_t(pixels.channels);
    for (std::size_t c = 0; c < channels; ++c) {
        std::vector<float> own;
        for (std::size_t i = c; i < black.pattern.size(); i += channels)
            own.push_back(black.pattern[i]);
        const double highest = double(largest(own)) + largest(black.by_column) + largest(black.by_row);
        if (!(highest < pixels.white[c]))
            return Error{ "black level " + shown_number(highest) + " is not below white level " +
                          shown_number(pixels.white[c]) };
    }
    return {};
}

float BlackLevels::at(int row, int column) const
{
    const std::size_t place = std::size_t(row % rows * columns + column % columns);
    return pattern[place] + (by_column.empty() ? 0 : by_column[std::size_t(column)]) +
           (by_row.empty() ? 0 : by_row[std::size_t(row)]);
}

RowScaler::RowScaler(const RawPixels& pixels) : m_pixels(pixels)
{
    const BlackLevels& black = pixels.black;
    m_black.reserve(std::size_t(black.rows) * std::size_t(pixels.width) * std::size_t(pixels.channels));
    for (int row = 0; row < black.rows; ++row)
        for (int x = 0; x < pixels.width; ++x)
            for (int c = 0; c < pixels.channels; ++c) {
                const int place = (row * black.columns + x % black.columns) * pixels.channels + c;
                const float column_part = black.by_column.empty() ? 0 : black.by_column[std::size_t(x)];
                m_black.push_back(black.pattern[std::size_t(place)] + column_part);
                m_factor.push_back(1 / (pixels.white[std::size_t(c)] - m_black.back()));
            }
}

template<class Sample> void RowScaler::scale_row(const Sample* source, int row, float* target) const
{
    const int channels = m_pixels.channels;
    const std::size_t start =
        std::size_t(row % m_pixels.black.rows) * std::size_t(m_pixels.width) * std::size_t(channels);
    const float* black = m_black.data() + start;
    const float* factor = m_factor.data() + start;
    std::vector<float> black_here, factor_here; // where each row has a black level of its own
    if (!m_pixels.black.by_row.empty()) {
        const float row_part = m_pixels.black.by_row[std::size_t(row)];
        for (int i = 0; i < m_pixels.width * channels; ++i) {
            black_here.push_back(black[i] + row_part);
            factor_here.push_back(1 / (m_pixels.white[std::size_t(i % channels)] - black_here.back()));
        }
        black = black_here.data();
        factor = factor_here.data();
    }
    const auto scaled = [&](Sample value, int i) {
        return std::min(std::max((float(value) - black[i]) * factor[i], 0.0f), 1.0f);
    };
    if constexpr (std::is_same_v<Sample, std::uint16_t>)
        if (channels == 1 && m_pixels.pixel_stride == 1)
            return scale_shorts(source, black, factor, std::size_t(m_pixels.width), target);
    for (int x = 0; x < m_pixels.width; ++x)
        for (int c = 0; c < channels; ++c)
            target[x * channels + c] = scaled(source[x * m_pixels.pixel_stride + c], x * channels + c);
}

void RowScaler::scale(int row, float* target) const
{
    if (m_pixels.shorts)
        scale_row(m_pixels.shorts + row * m_pixels.row_stride, row, target);
    else
        scale_row(m_pixels.floats + row * m_pixels.row_stride, row, target);
}

void describe_levels(const RawPixels& pixels, CameraFacts& facts)
{
    facts.width = pixels.width;
    facts.height = pixels.height;
    facts.cfa_pattern = pixels.cfa.letters;
    facts.white_level = pixels.white[0];

    const auto mean = [](const std::vector<float>& values) {
        double sum = 0;
        for (const float v : values)
            sum += v;
        return values.empty() ? 0 : sum / double(values.size());
    };
    const double offset = mean(pixels.black.by_column) + mean(pixels.black.by_row);
    const BlackLevels& black = pixels.black;
    const CfaPattern& cfa = pixels.cfa;
    std::array<double, 4> sums{}, counts{};
    // Over one common period of both patterns; every position counts once.
    const int rows = cfa.rows ? cfa.rows * black.rows : black.rows;
    const int columns = cfa.rows ? cfa.columns * black.columns : black.columns;
    for (int row = 0; row < rows; ++row)
        for (int x = 0; x < columns; ++x)
            for (int c = 0; c < pixels.channels; ++c) {
                int color = cfa.rows ? cfa.color(row, x) : c;
                if (cfa.rows == 2 && color == 1 &&
                    row % 2 == 1) // Bayer: the green of the second row is the second green
                    color = 3;
                const int place = (row % black.rows * black.columns + x % black.columns) * pixels.channels + c;
                sums[std::size_t(color)] += black.pattern[std::size_t(place)];
                counts[std::size_t(color)] += 1;
            }
    for (std::size_t i = 0; i < 4; ++i)
        facts.black_level[i] = counts[i] > 0 ? float(sums[i] / counts[i] + offset) : facts.black_level[1];
}

} // namespace srisp
