// SPDX-License-Identifier: Apache-2.0
#include "noise/estimate_noise.h"

#include <algorithm>
#include <cmath>

#include "base/shown_text.h"
#include "noise/flat_blocks.h"

namespace srisp {

namespace {

constexpr int kBins = 32;               // of the square root of brightness
constexpr std::size_t kLeastBlocks = 6; // that count in a bin
constexpr std::size_t kLeastBins = 4;
constexpr double kLeastRange = 2.5; // between the means of the brightest and the darkest bin

/// A bin's flat blocks.
struct Point {
    double mean, variance, blocks;
};

double median_of(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Whether noise alone may have made the texture that a block shows: noise of the same variance leaves a sixteenth in
/// the means of 4 × 4, and four times as much in one block of a few thousand. Textures of real things fail, and so do
/// files whose fine noise a lossy compression has taken away.
bool may_be_flat(const BlockStatistics& block)
{
    constexpr float kMostTexture = 4.0f / 16;
    return block.texture < kMostTexture * block.variance;
}

/// The flattest quarter of a bin; no blocks where that is too few.
Point flat_point(std::vector<BlockStatistics> blocks)
{
    blocks.erase(std::partition(blocks.begin(), blocks.end(), may_be_flat), blocks.end());
    const std::size_t count = blocks.size() / 4;
    if (count < kLeastBlocks)
        return {};
    std::nth_element(blocks.begin(), blocks.begin() + std::ptrdiff_t(count), blocks.end(),
                     [](const auto& one, const auto& other) { return one.texture < other.texture; });
    double mean = 0;
    std::vector<double> variances;
    for (std::size_t i = 0; i < count; ++i) {
        mean += double(blocks[i].mean) / double(count);
        variances.push_back(blocks[i].variance);
    }
    const double median_of_chi = std::pow(1 - 2 / (9 * kBlockFreedom), 3); // [Wilson and Hilferty]
    return { mean, median_of(std::move(variances)) / median_of_chi, double(count) };
}

std::vector<Point> flat_points(const std::vector<BlockStatistics>& blocks)
{
    std::vector<std::vector<BlockStatistics>> bins(kBins);
    for (const BlockStatistics& block : blocks) {
        const double place = std::sqrt(std::clamp(double(block.mean), 0.0, 1.0)) * kBins;
        bins[std::min(std::size_t(place), std::size_t(kBins - 1))].push_back(block);
    }
    std::vector<Point> points;
    for (auto& bin : bins)
        if (const Point point = flat_point(std::move(bin)); point.blocks > 0)
            points.push_back(point);
    return points;
}

struct Line {
    double shot, read;
    double at(double mean) const { return std::max(shot * mean + read, 1e-12); }
};

/// Least squares; read noise below 0 becomes 0, and the slope is what fits best with it.
Line weighted_line(const std::vector<Point>& points, const std::vector<double>& weights)
{
    double w = 0, wm = 0, wv = 0, wmm = 0, wmv = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [mean, variance, blocks] = points[i];
        w += weights[i];
        wm += weights[i] * mean;
        wv += weights[i] * variance;
        wmm += weights[i] * mean * mean;
        wmv += weights[i] * mean * variance;
    }
    const double shot = (w * wmv - wm * wv) / (w * wmm - wm * wm), read = (wv - shot * wm) / w;
    return read >= 0 ? Line{ shot, read } : Line{ wmv / wmm, 0 };
}

/// A variance scatters in proportion to itself, so weights follow from the line before; what lies off it by more than
/// its neighbours do counts less (Cauchy's weights).
Line robust_line(const std::vector<Point>& points)
{
    std::vector<double> weights;
    for (const Point& point : points)
        weights.push_back(point.blocks / std::pow(std::max(point.variance, 1e-12), 2));
    Line line = weighted_line(points, weights);
    constexpr int kRounds = 30;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<double> off;
        for (const Point& point : points)
            off.push_back(std::abs(point.variance / line.at(point.mean) - 1) * std::sqrt(point.blocks));
        const double expected = std::sqrt(3.14 / kBlockFreedom); // of a median of χ²
        const double scale = std::max(1.5 * median_of(off), expected);
        for (std::size_t i = 0; i < points.size(); ++i)
            weights[i] = points[i].blocks / std::pow(line.at(points[i].mean), 2) / (1 + std::pow(off[i] / scale, 2));
        line = weighted_line(points, weights);
    }
    return line;
}

Expected<Line> color_line(const std::vector<BlockStatistics>& blocks)
{
    const std::vector<Point> points = flat_points(blocks);
    if (points.size() < kLeastBins)
        return Error{ "too few flat blocks (" + std::to_string(points.size()) + " of " + std::to_string(kBins) +
                      " steps of brightness have enough, " + std::to_string(kLeastBins) + " are needed)" };
    if (points.back().mean < kLeastRange * points.front().mean)
        return Error{ "too small a range of brightness (" + shown_number(points.front().mean) + " to " +
                      shown_number(points.back().mean) + ", a factor of " + shown_number(kLeastRange) + " is needed)" };
    const Line line = robust_line(points);
    if (!(line.shot > 0))
        return Error{ "its variance does not grow with brightness" };
    return line;
}

} // namespace

Expected<NoiseModel> estimate_noise(const RawPixels& pixels, int threads)
{
    if (pixels.channels != 1)
        return Error{ "noise cannot be estimated from an image of three channels: demosaicing has mixed it" };
    const auto blocks = block_statistics(pixels, threads);
    NoiseModel noise;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto line = color_line(blocks[c]);
        if (!line)
            return Error{ std::string("noise cannot be estimated: ") + "RGB"[c] + ": " + line.error().message };
        noise.shot[c] = line->shot;
        noise.read[c] = line->read;
    }
    if (const Status possible = check_noise(noise); !possible)
        return Error{ "noise cannot be estimated: " + possible.error().message };
    return noise;
}

} // namespace srisp
