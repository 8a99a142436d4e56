// SPDX-License-Identifier: Apache-2.0
#include "quantile_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "statistics.h"

namespace srisp {

namespace {

constexpr int kSide = 64; // to which a thumbnail is reduced, about
constexpr double kDarkest = 1e-4;
constexpr float kClipped = 0.95f;
constexpr double kQuantiles[] = { 0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.995 };

/// Means over blocks of rows × columns pixels, whole blocks only.
std::vector<float> block_means(const float* plane, int height, int width)
{
    const int rows = std::max(1, height / kSide), columns = std::max(1, width / kSide);
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

std::array<float, kQuantileFeatures> quantile_features(Planes image, int height, int width)
{
    std::vector<float> channels[4];
    for (int c = 0; c < 3; ++c)
        channels[c] = block_means(image.plane(c), height, width);
    channels[3].resize(channels[0].size());
    for (std::size_t i = 0; i < channels[3].size(); ++i)
        channels[3][i] = static_cast<float>((double(channels[0][i]) + channels[1][i] + channels[2][i]) / 3);

    std::array<float, kQuantileFeatures> features;
    auto next = features.begin();
    for (std::vector<float>& values : channels) {
        Quantiles quantile(values);
        for (const double q : kQuantiles)
            *next++ = static_cast<float>(std::log(std::max(quantile(q), kDarkest)) * 0.5 + 1);
    }
    for (int c = 0; c < 3; ++c) {
        const auto clipped =
            std::count_if(channels[c].begin(), channels[c].end(), [](float v) { return v > kClipped; });
        *next++ = static_cast<float>(clipped) / static_cast<float>(channels[c].size());
    }
    return features;
}

} // namespace srisp
