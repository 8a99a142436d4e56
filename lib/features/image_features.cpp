// SPDX-License-Identifier: Apache-2.0
#include "features/image_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

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

constexpr int kPasses = 3, kDigitBits = 11;
constexpr std::uint32_t kDigits = 1u << kDigitBits, kSign = 0x80000000u;

std::uint32_t digit(std::uint32_t key, int pass)
{
    return (key >> (pass * kDigitBits)) & (kDigits - 1);
}

/// A number's bits, such that greater numbers have greater ones; and back.
std::uint32_t key_of(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits & kSign ? ~bits : bits | kSign;
}

float value_of(std::uint32_t key)
{
    const std::uint32_t bits = key & kSign ? key & ~kSign : ~key;
    float value;
    std::memcpy(&value, &bits, sizeof bits);
    return value;
}

/// Radix sort: of 4,096 values six times as fast as std::nth_element for ten quantiles.
void sort(std::vector<float>& values)
{
    std::vector<std::uint32_t> keys(values.size()), other(values.size());
    std::vector<std::uint32_t> places(kPasses * kDigits); // how many of each digit; then where the next of them goes
    for (std::size_t i = 0; i < values.size(); ++i) {
        keys[i] = key_of(values[i]);
        for (int pass = 0; pass < kPasses; ++pass)
            ++places[pass * kDigits + digit(keys[i], pass)];
    }
    for (int pass = 0; pass < kPasses; ++pass) {
        std::uint32_t* const place = &places[pass * kDigits];
        std::uint32_t next = 0;
        for (std::uint32_t d = 0; d < kDigits; ++d) {
            const std::uint32_t count = place[d];
            place[d] = next;
            next += count;
        }
        for (const std::uint32_t key : keys)
            other[place[digit(key, pass)]++] = key;
        keys.swap(other);
    }
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = value_of(keys[i]);
}

} // namespace

Quantiles::Quantiles(std::vector<float> values) : m_sorted(std::move(values))
{
    sort(m_sorted);
}

double Quantiles::operator()(double q) const
{
    const double position = q * (m_sorted.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const double fraction = position - std::floor(position);
    if (fraction == 0 || below + 1 == m_sorted.size())
        return m_sorted[below];
    return m_sorted[below] + fraction * (static_cast<double>(m_sorted[below + 1]) - m_sorted[below]);
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
void add_statistics(const float* values, std::size_t count, const Quantiles& quantile, int channel,
                    std::array<float, 12>& result)
{
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum += values[i];
    const double median = quantile(0.5), bright = quantile(0.98);
    const double numbers[] = { std::log(std::max(sum / count, kFloor)), sum_of_logs(values, count) / count,
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
        add_statistics(values, count, Quantiles({ values, values + count }), c, result);
    }
    return result;
}

namespace {

constexpr double kDarkest = 1e-4;
constexpr float kClipped = 0.95f;
constexpr double kColorFloor = 2e-3; // added, so that noise in the dark has little colour
constexpr double kBright = 0.75;     // quantile of the means from which on pixels are bright
constexpr double kQuantiles[] = { 0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.995 };
constexpr double kColorQuantiles[] = { 0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98 };

/// ln of each pixel's ratio to green.
std::vector<float> log_ratios(const std::vector<float>& channel, const std::vector<float>& green)
{
    std::vector<float> result(channel.size());
    for (std::size_t i = 0; i < channel.size(); ++i)
        result[i] = static_cast<float>(std::log((channel[i] + kColorFloor) / (green[i] + kColorFloor)));
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

std::array<float, kQuantileFeatures> quantile_features(const ReducedImage& image, const ChannelQuantiles& channels)
{
    const std::vector<float> means = means_of(image);
    const Quantiles mean_quantiles(means);
    std::array<float, kQuantileFeatures> features;
    auto next = features.begin();
    for (const Quantiles* quantile : { &channels[0], &channels[1], &channels[2], &mean_quantiles })
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
        const Quantiles quantile(ratios);
        for (const double q : kColorQuantiles)
            *next++ = static_cast<float>(quantile(q));
    }
    return features;
}

} // namespace

std::array<float, kQuantileFeatures> quantile_features(const ReducedImage& image)
{
    return quantile_features(image, channel_quantiles(image));
}

ColorFeatures color_features(const PlanarImage& image, const ReducedImage& small)
{
    const std::size_t count = static_cast<std::size_t>(image.height) * image.width;
    const ChannelQuantiles quantiles = channel_quantiles(small);
    ColorFeatures features{ {}, quantile_features(small, quantiles) };
    if (small[0].size() != count)
        features.statistics = statistics(image.planes, count);
    else
        for (int c = 0; c < 3; ++c)
            add_statistics(image.planes.plane(c), count, quantiles[c], c, features.statistics);
    return features;
}

} // namespace srisp
