// SPDX-License-Identifier: Apache-2.0
#include "features/quantile_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "features/quantiles.h"

namespace srisp {

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

} // namespace

std::array<float, kQuantileFeatures> quantile_features(const ReducedImage& image)
{
    std::vector<float> channels[4] = { image[0], image[1], image[2], std::vector<float>(image[0].size()) };
    for (std::size_t i = 0; i < channels[3].size(); ++i)
        channels[3][i] = static_cast<float>((double(channels[0][i]) + channels[1][i] + channels[2][i]) / 3);

    std::array<float, kQuantileFeatures> features;
    auto next = features.begin();
    double bright = 0; // of the means: they come last
    for (const std::vector<float>& channel : channels) {
        const Quantiles quantile(channel);
        for (const double q : kQuantiles)
            *next++ = static_cast<float>(std::log(std::max(quantile(q), kDarkest)) * 0.5 + 1);
        bright = quantile(kBright);
    }
    for (int c = 0; c < 3; ++c) {
        const auto clipped =
            std::count_if(channels[c].begin(), channels[c].end(), [](float v) { return v > kClipped; });
        *next++ = static_cast<float>(clipped) / static_cast<float>(channels[c].size());
    }
    const std::vector<float> red = log_ratios(channels[0], channels[1]), blue = log_ratios(channels[2], channels[1]);
    for (const std::vector<float>& ratios :
         { red, blue, bright_ones(red, channels[3], bright), bright_ones(blue, channels[3], bright) }) {
        const Quantiles quantile(ratios);
        for (const double q : kColorQuantiles)
            *next++ = static_cast<float>(quantile(q));
    }
    return features;
}

} // namespace srisp
