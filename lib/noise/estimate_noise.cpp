// SPDX-License-Identifier: Apache-2.0
#include "noise/estimate_noise.h"

#include <algorithm>
#include <cmath>

#include "base/shown_text.h"
#include "noise/flat_blocks.h"

namespace srisp {

namespace {

constexpr int kBins = 32;               // of the square root of brightness
constexpr std::size_t kLeastBlocks = 8; // of a bin, that count
constexpr std::size_t kLeastBins = 4;
constexpr double kLeastRange = 2.5; // between the means of the brightest and the darkest bin

/// Of the variances of blocks of pure noise, over the true one (χ² of kBlockFreedom degrees of freedom): their lowest
/// tenth ends here; and the mean of those between two limits.
constexpr double kLowestTenth = 0.763;
constexpr double kLeastRatio = 0.5, kMostRatio = 1.1, kMeanRatio = 0.906;

/// A bin's blocks.
struct Point {
    double mean, variance, blocks;
};

double quantile_of(std::vector<double> values, double fraction)
{
    const auto place = values.begin() + std::ptrdiff_t(double(values.size()) * fraction);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// Whether noise alone may have made the texture that a block shows: noise of the same variance leaves a sixteenth in
/// the means of 4 × 4, and 2.5 times as much in one block of a hundred. Textures of real things fail, and so do files
/// whose fine noise a lossy compression has taken away.
bool may_be_flat(const BlockStatistics& block)
{
    constexpr float kMostTexture = 2.5f / 16;
    return block.texture < kMostTexture * block.variance;
}

/// What a bin says at first, by the lowest of its variances.
Point first_point(const std::vector<BlockStatistics>& blocks)
{
    double mean = 0;
    std::vector<double> variances;
    for (const BlockStatistics& block : blocks) {
        mean += double(block.mean) / double(blocks.size());
        variances.push_back(block.variance);
    }
    return { mean, quantile_of(std::move(variances), 0.1) / kLowestTenth, double(blocks.size()) };
}

/// The flattest third of each bin that has enough: the least textured ones that noise alone may have made.
std::vector<std::vector<BlockStatistics>> flattest_blocks(const std::vector<BlockStatistics>& blocks)
{
    std::vector<std::vector<BlockStatistics>> bins(kBins), result;
    for (const BlockStatistics& block : blocks)
        if (may_be_flat(block)) {
            const double place = std::sqrt(std::clamp(double(block.mean), 0.0, 1.0)) * kBins;
            bins[std::min(std::size_t(place), std::size_t(kBins - 1))].push_back(block);
        }
    for (auto& bin : bins) {
        const std::size_t count = bin.size() / 3;
        if (count < kLeastBlocks)
            continue;
        std::nth_element(bin.begin(), bin.begin() + std::ptrdiff_t(count), bin.end(),
                         [](const auto& one, const auto& other) { return one.texture < other.texture; });
        bin.resize(count);
        result.push_back(std::move(bin));
    }
    return result;
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
        const double expected = std::sqrt(6 / kBlockFreedom); // of the lowest tenth of χ²
        const double scale = std::max(1.5 * quantile_of(off, 0.5), expected);
        for (std::size_t i = 0; i < points.size(); ++i)
            weights[i] = points[i].blocks / std::pow(line.at(points[i].mean), 2) / (1 + std::pow(off[i] / scale, 2));
        line = weighted_line(points, weights);
    }
    return line;
}

/// Fits the line again and again to all blocks that lie near it. Texture only adds to a variance, so few of those below
/// the line and just above it have any, however many of the others do.
Line refined_line(const std::vector<BlockStatistics>& blocks, Line line)
{
    constexpr int kRounds = 40;
    for (int round = 0; round < kRounds && line.shot > 0; ++round) {
        std::vector<Point> near;
        std::vector<double> weights;
        for (const BlockStatistics& block : blocks) {
            const double expected = line.at(block.mean), ratio = double(block.variance) / expected;
            if (ratio < kLeastRatio || ratio > kMostRatio)
                continue;
            near.push_back({ block.mean, double(block.variance) / kMeanRatio, 1 });
            weights.push_back(1 / (expected * expected));
        }
        if (near.size() < kLeastBlocks)
            return {};
        line = weighted_line(near, weights);
    }
    return line;
}

Expected<Line> color_line(const std::vector<BlockStatistics>& blocks)
{
    std::vector<Point> points;
    std::vector<BlockStatistics> flat;
    for (const auto& bin : flattest_blocks(blocks)) {
        points.push_back(first_point(bin));
        flat.insert(flat.end(), bin.begin(), bin.end());
    }
    if (points.size() < kLeastBins)
        return Error{ "too few flat blocks (" + std::to_string(points.size()) + " of " + std::to_string(kBins) +
                      " steps of brightness have enough, " + std::to_string(kLeastBins) + " are needed)" };
    if (points.back().mean < kLeastRange * points.front().mean)
        return Error{ "too small a range of brightness (" + shown_number(points.front().mean) + " to " +
                      shown_number(points.back().mean) + ", a factor of " + shown_number(kLeastRange) + " is needed)" };
    const Line line = refined_line(flat, robust_line(points));
    if (!(line.shot > 0))
        return Error{ "its variance does not grow with brightness" };
    return line;
}

} // namespace

Expected<NoiseModel> estimate_noise(const RawPixels& pixels, int threads)
{
    if (pixels.channels != 1)
        return Error{ "three channels: demosaicing has mixed the noise of neighbours" };
    const auto blocks = block_statistics(pixels, threads);
    NoiseModel noise;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto line = color_line(blocks[c]);
        if (!line)
            return Error{ std::string(1, "RGB"[c]) + ": " + line.error().message };
        noise.shot[c] = line->shot;
        noise.read[c] = line->read;
    }
    if (const Status possible = check_noise(noise); !possible)
        return possible.error();
    return noise;
}

} // namespace srisp
