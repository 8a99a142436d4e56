// SPDX-License-Identifier: Apache-2.0
#include "noise/flat_blocks.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace srisp {

namespace {

constexpr int kSide = 16, kPart = 4, kParts = kSide / kPart;
using Block = std::array<std::array<float, kSide>, kSide>;

/// Reads stored values as (value − black) / (white − black). False where one is clipped, or no sensor's: floats of
/// damaged files can be anything, and their squares too much to be numbers.
bool read_block(const RawPixels& pixels, int row, int column, Block& block)
{
    constexpr float kLeast = -1, kWhite = 0.95f; // sensors bend before they clip
    const CfaPattern& cfa = pixels.cfa;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const int at_row = row + y * cfa.rows, at_column = column + x * cfa.columns;
            const std::ptrdiff_t place = at_row * pixels.row_stride + at_column * std::ptrdiff_t(pixels.pixel_stride);
            const float stored = pixels.shorts ? float(pixels.shorts[place]) : pixels.floats[place];
            const float black = pixels.black.at(at_row, at_column);
            const float value = (stored - black) / (pixels.white[0] - black);
            if (!(value >= kLeast && value <= kWhite) || (pixels.shorts && stored == 0))
                return false;
            block[std::size_t(y)][std::size_t(x)] = value;
        }
    return true;
}

/// The noise's variance from second differences along both directions, whose squares are 36 times as large.
double difference_variance(const Block& block)
{
    double sum = 0;
    for (std::size_t y = 1; y + 1 < kSide; ++y) {
        const auto column = [&](std::size_t x) {
            return double(block[y - 1][x]) - 2 * double(block[y][x]) + double(block[y + 1][x]);
        };
        for (std::size_t x = 1; x + 1 < kSide; ++x) {
            const double difference = column(x - 1) - 2 * column(x) + column(x + 1);
            sum += difference * difference;
        }
    }
    return sum / (36.0 * (kSide - 2) * (kSide - 2));
}

/// The mean of a block, and the mean square by which its parts' means lie off a plane.
std::pair<double, double> mean_and_texture(const Block& block)
{
    double sum = 0, squares = 0, along_x = 0, along_y = 0;
    for (std::size_t part = 0; part < kParts * kParts; ++part) {
        const std::size_t row = part / kParts, column = part % kParts;
        double mean = 0;
        for (std::size_t i = 0; i < kPart * kPart; ++i)
            mean += double(block[row * kPart + i / kPart][column * kPart + i % kPart]) / (kPart * kPart);
        sum += mean;
        squares += mean * mean;
        along_x += mean * (double(column) - 1.5);
        along_y += mean * (double(row) - 1.5);
    }
    constexpr double kCount = kParts * kParts, kMoment = 20; // Σ (column − 1.5)²
    const double rest = squares - sum * sum / kCount - (along_x * along_x + along_y * along_y) / kMoment;
    return { sum / kCount, std::max(rest, 0.0) / (kCount - 3) };
}

} // namespace

std::array<std::vector<BlockStatistics>, 3> block_statistics(const RawPixels& pixels, int threads)
{
    const CfaPattern& cfa = pixels.cfa;
    const int high = kSide * cfa.rows, wide = kSide * cfa.columns;
    std::vector<std::array<std::vector<BlockStatistics>, 3>> by_row(std::size_t(pixels.height / high));
    parallel_tasks(std::int64_t(by_row.size()), threads, [&](std::int64_t task) {
        for (int column = 0; column + wide <= pixels.width; column += wide)
            for (int site = 0; site < cfa.rows * cfa.columns; ++site) {
                const int site_row = site / cfa.columns, site_column = site % cfa.columns;
                Block block;
                if (!read_block(pixels, int(task) * high + site_row, column + site_column, block))
                    continue;
                const auto [mean, texture] = mean_and_texture(block);
                const auto color = std::size_t(cfa.color(site_row, site_column));
                by_row[std::size_t(task)][color].push_back(
                    { float(mean), float(difference_variance(block)), float(texture) });
            }
    });
    std::array<std::vector<BlockStatistics>, 3> result;
    for (const auto& row : by_row)
        for (std::size_t c = 0; c < 3; ++c)
            result[c].insert(result[c].end(), row[c].begin(), row[c].end());
    return result;
}

} // namespace srisp
