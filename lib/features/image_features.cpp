// SPDX-License-Identifier: Apache-2.0
#include "features/image_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "features/lanes.h"
#include "features/sums.h"

namespace srisp {

namespace {

constexpr int kSide = 64; // of the reduced plane, about

std::vector<float> block_means(const PlanarImage& image, int channel)
{
    const float* const plane = image.planes.plane(channel);
    const int height = image.height, width = image.width;
    const int rows = std::max(1, height / kSide), columns = std::max(1, width / kSide);
    if (rows == 1 && columns == 1)
        return { plane, plane + static_cast<std::ptrdiff_t>(height) * width };
    std::vector<float> means;
    means.reserve(static_cast<std::size_t>(height / rows) * (width / columns));
    for (int y = 0; y + rows <= height; y += rows)
        for (int x = 0; x + columns <= width; x += columns) {
            double sum = 0;
            for (int dy = 0; dy < rows; ++dy)
                for (int dx = 0; dx < columns; ++dx)
                    sum += plane[static_cast<std::ptrdiff_t>(y + dy) * width + x + dx];
            means.push_back(static_cast<float>(sum / (rows * columns)));
        }
    return means;
}

} // namespace

ReducedImage reduced(const PlanarImage& image)
{
    return { block_means(image, 0), block_means(image, 1), block_means(image, 2) };
}

namespace {

constexpr std::uint32_t kSign = 0x80000000u, kRanges = 4096;

/// Each number's bits, such that greater numbers have greater ones; the least and the greatest of them.
SRISP_WIDE_LANES void make_keys(const float* values, std::size_t count, std::uint32_t* keys, std::uint32_t& least_key,
                                std::uint32_t& most_key)
{
    std::uint32_t least = ~0u, most = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        const std::uint32_t key = bits & kSign ? ~bits : bits | kSign;
        keys[i] = key;
        least = std::min(least, key);
        most = std::max(most, key);
    }
    least_key = least;
    most_key = most;
}

float value_of(std::uint32_t key)
{
    const std::uint32_t bits = key & kSign ? key & ~kSign : ~key;
    float value;
    std::memcpy(&value, &bits, sizeof bits);
    return value;
}

} // namespace

// Ranges of equal width among the keys: about equal ratios among the values, of which 4,096 fill few to a range.
// Sorting all of them took twice as long.
Quantiles::Quantiles(const std::vector<float>& values) : m_keys(values.size()), m_ends(kRanges + 1)
{
    std::vector<std::uint32_t> keys(values.size());
    std::uint32_t most;
    make_keys(values.data(), values.size(), keys.data(), m_least, most);
    while (range_of(most) >= kRanges)
        ++m_shift;
    for (const std::uint32_t key : keys)
        ++m_ends[range_of(key) + 1];
    std::partial_sum(m_ends.begin(), m_ends.end(), m_ends.begin()); // where each range begins
    for (const std::uint32_t key : keys)
        m_keys[m_ends[range_of(key)]++] = key;
}

float Quantiles::ranked(std::size_t rank)
{
    const std::size_t range = range_of(m_keys[rank]);
    const auto begin = m_keys.begin() + (range == 0 ? 0 : m_ends[range - 1]), end = m_keys.begin() + m_ends[range];
    if (!std::is_sorted(begin, end))
        std::sort(begin, end);
    return value_of(m_keys[rank]);
}

double Quantiles::operator()(double q)
{
    const double position = q * (m_keys.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const double fraction = position - std::floor(position);
    const double value = ranked(below);
    if (fraction == 0 || below + 1 == m_keys.size())
        return value;
    return value + fraction * (ranked(below + 1) - value);
}

namespace {

constexpr double kFloor = 1e-3;

/// Σ ln max(v, kFloor): logarithms of products of numbers in [1e-3, 1], as many as a double holds with room to spare.
double sum_of_logs(const float* values, std::size_t count)
{
    constexpr std::size_t factors = 64;
    double sum = 0;
    for (std::size_t i = 0; i < count; i += factors) {
        double product = 1;
        for (std::size_t k = i; k < std::min(i + factors, count); ++k)
            product *= std::max<double>(values[k], kFloor);
        sum += std::log(product);
    }
    return sum;
}

/// Numbers of one channel, to their places among the statistics.
void add_statistics(const float* values, std::size_t count, Quantiles& quantile, int channel,
                    std::array<float, 12>& result)
{
    const double mean = sum_of(values, count) / count, median = quantile(0.5), bright = quantile(0.98);
    const double numbers[] = { std::log(std::max(mean, kFloor)), sum_of_logs(values, count) / count,
                               std::log(std::max(median, kFloor)), std::log(std::max(bright, kFloor)) };
    for (int i = 0; i < 4; ++i)
        result[i * 3 + channel] = static_cast<float>(numbers[i] * 0.5 + 1);
}

} // namespace

std::array<float, 12> statistics(Planes image, std::size_t count)
{
    std::array<float, 12> result;
    for (int c = 0; c < 3; ++c) {
        const float* const values = image.plane(c);
        Quantiles quantile({ values, values + count });
        add_statistics(values, count, quantile, c, result);
    }
    return result;
}

namespace {

constexpr double kDarkest = 1e-4;
constexpr float kClipped = 0.95f;
constexpr float kColorFloor = 2e-3f; // added, so that noise in the dark has little colour
constexpr double kBright = 0.75;     // quantile of the means from which on pixels are bright
constexpr double kQuantiles[] = { 0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.995 };
constexpr double kColorQuantiles[] = { 0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98 };

/// ln((channel + kColorFloor) / (green + kColorFloor)) of each pixel.
SRISP_WIDE_LANES void take_log_ratios(const float* channel, const float* green, std::size_t count, float* result)
{
    for (std::size_t i = 0; i < count; i += kLanes) {
        const std::size_t bytes = std::min<std::size_t>(kLanes, count - i) * sizeof(float);
        Lanes ratio{}, base{};
        std::memcpy(&ratio, channel + i, bytes);
        std::memcpy(&base, green + i, bytes);
        ratio = (ratio + kColorFloor) / (base + kColorFloor);
        take_log(ratio);
        std::memcpy(result + i, &ratio, bytes);
    }
}

std::vector<float> log_ratios(const std::vector<float>& channel, const std::vector<float>& green)
{
    std::vector<float> result(channel.size());
    take_log_ratios(channel.data(), green.data(), channel.size(), result.data());
    return result;
}

/// Those values whose pixel's mean is at least `darkest`.
std::vector<float> bright_ones(const std::vector<float>& values, const std::vector<float>& means, double darkest)
{
    std::vector<float> result;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (means[i] >= darkest)
            result.push_back(values[i]);
    return result;
}

using ChannelQuantiles = std::array<Quantiles, 3>;

ChannelQuantiles channel_quantiles(const ReducedImage& image)
{
    return { Quantiles(image[0]), Quantiles(image[1]), Quantiles(image[2]) };
}

/// The mean of R, G and B of each pixel.
std::vector<float> means_of(const ReducedImage& image)
{
    std::vector<float> means(image[0].size());
    for (std::size_t i = 0; i < means.size(); ++i)
        means[i] = static_cast<float>((double(image[0][i]) + image[1][i] + image[2][i]) / 3);
    return means;
}

std::array<float, kQuantileFeatures> quantile_features(const ReducedImage& image, ChannelQuantiles& channels)
{
    const std::vector<float> means = means_of(image);
    Quantiles mean_quantiles(means);
    std::array<float, kQuantileFeatures> features;
    auto next = features.begin();
    for (Quantiles* quantile : { &channels[0], &channels[1], &channels[2], &mean_quantiles })
        for (const double q : kQuantiles)
            *next++ = static_cast<float>(std::log(std::max((*quantile)(q), kDarkest)) * 0.5 + 1);
    for (const std::vector<float>& channel : image) {
        const auto clipped = std::count_if(channel.begin(), channel.end(), [](float v) { return v > kClipped; });
        *next++ = static_cast<float>(clipped) / static_cast<float>(channel.size());
    }
    const double bright = mean_quantiles(kBright);
    const std::vector<float> red = log_ratios(image[0], image[1]), blue = log_ratios(image[2], image[1]);
    for (const std::vector<float>& ratios :
         { red, blue, bright_ones(red, means, bright), bright_ones(blue, means, bright) }) {
        Quantiles quantile(ratios);
        for (const double q : kColorQuantiles)
            *next++ = static_cast<float>(quantile(q));
    }
    return features;
}

} // namespace

std::array<float, kQuantileFeatures> quantile_features(const ReducedImage& image)
{
    ChannelQuantiles quantiles = channel_quantiles(image);
    return quantile_features(image, quantiles);
}

ColorFeatures color_features(const PlanarImage& image, const ReducedImage& small)
{
    const std::size_t count = static_cast<std::size_t>(image.height) * image.width;
    ChannelQuantiles quantiles = channel_quantiles(small);
    ColorFeatures features{ {}, quantile_features(small, quantiles) };
    if (small[0].size() != count)
        features.statistics = statistics(image.planes, count);
    else
        for (int c = 0; c < 3; ++c)
            add_statistics(image.planes.plane(c), count, quantiles[c], c, features.statistics);
    return features;
}

} // namespace srisp
