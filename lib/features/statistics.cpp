// SPDX-License-Identifier: Apache-2.0
#include "features/statistics.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "features/quantiles.h"

namespace srisp {

namespace {

constexpr double kFloor = 1e-3;

/// Σ ln max(v, kFloor): logarithms of products of numbers in [1e-3, 1], as many as a double holds with room to spare.
double sum_of_logs(const std::vector<float>& values)
{
    constexpr std::size_t factors = 64;
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); i += factors) {
        double product = 1;
        for (std::size_t k = i; k < std::min(i + factors, values.size()); ++k)
            product *= std::max<double>(values[k], kFloor);
        sum += std::log(product);
    }
    return sum;
}

} // namespace

std::array<float, 12> statistics(Planes image, std::size_t count)
{
    std::array<float, 12> result;
    for (int c = 0; c < 3; ++c) {
        std::vector<float> values(image.plane(c), image.plane(c) + count);
        double sum = 0;
        for (const float v : values)
            sum += v;
        const double log_sum = sum_of_logs(values);
        const Quantiles quantile(std::move(values));
        const double median = quantile(0.5), bright = quantile(0.98);
        const double numbers[] = { std::log(std::max(sum / count, kFloor)), log_sum / count,
                                   std::log(std::max(median, kFloor)), std::log(std::max(bright, kFloor)) };
        for (int i = 0; i < 4; ++i)
            result[i * 3 + c] = static_cast<float>(numbers[i] * 0.5 + 1);
    }
    return result;
}

} // namespace srisp
