// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <srisp/metrics.h>

namespace srisp {

namespace {

constexpr int kRadius = 5, kWindow = 2 * kRadius + 1;

/// Sums to 1.
std::array<double, kWindow> gaussian()
{
    constexpr double sigma = 1.5;
    std::array<double, kWindow> weights;
    double sum = 0;
    for (int i = 0; i < kWindow; ++i)
        sum += weights[std::size_t(i)] = std::exp(-(i - kRadius) * (i - kRadius) / (2 * sigma * sigma));
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

/// Weighted means in a window: of result and truth, of their squares and of their product.
using Moments = std::array<double, 5>;

double similarity(const Moments& m)
{
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const double variances = m[2] - m[0] * m[0] + m[3] - m[1] * m[1], covariance = m[4] - m[0] * m[1];
    return (2 * m[0] * m[1] + c1) * (2 * covariance + c2) / ((m[0] * m[0] + m[1] * m[1] + c1) * (variances + c2));
}

/// The moments of one channel in windows of one column: rows y … y + 10.
void down_columns(ImageView result, ImageView truth, int y, int channel, const std::array<double, kWindow>& weights,
                  std::vector<Moments>& columns)
{
    std::fill(columns.begin(), columns.end(), Moments{});
    for (int i = 0; i < kWindow; ++i)
        for (int x = 0; x < truth.width; ++x) {
            const double r = std::clamp(result.pixel(x, y + i)[channel], 0.0f, 1.0f),
                         t = truth.pixel(x, y + i)[channel];
            const double weight = weights[std::size_t(i)];
            Moments& m = columns[std::size_t(x)];
            m[0] += weight * r;
            m[1] += weight * t;
            m[2] += weight * r * r;
            m[3] += weight * t * t;
            m[4] += weight * r * t;
        }
}

} // namespace

double ssim(ImageView result, ImageView truth)
{
    if (truth.width < kWindow || truth.height < kWindow)
        return std::numeric_limits<double>::quiet_NaN();
    const auto weights = gaussian();
    std::vector<Moments> columns(std::size_t(truth.width));
    double sum = 0;
    for (int y = 0; y + kWindow <= truth.height; ++y)
        for (int channel = 0; channel < 3; ++channel) {
            down_columns(result, truth, y, channel, weights, columns);
            for (int x = 0; x + kWindow <= truth.width; ++x) {
                Moments window{};
                for (int i = 0; i < kWindow; ++i)
                    for (std::size_t k = 0; k < window.size(); ++k)
                        window[k] += weights[std::size_t(i)] * columns[std::size_t(x + i)][k];
                sum += similarity(window);
            }
        }
    return sum / (3.0 * (truth.width - kWindow + 1) * (truth.height - kWindow + 1));
}

} // namespace srisp
