// SPDX-License-Identifier: Apache-2.0
#include "statistics.h"

#include <algorithm>
#include <cmath>

namespace srisp {

double quantile(std::vector<float>& values, double q)
{
    const double position = q * (values.size() - 1);
    const auto below = values.begin() + static_cast<std::ptrdiff_t>(position);
    std::nth_element(values.begin(), below, values.end());
    const double fraction = position - std::floor(position);
    if (fraction == 0 || below + 1 == values.end())
        return *below;
    return *below + fraction * (static_cast<double>(*std::min_element(below + 1, values.end())) - *below);
}

std::array<float, 12> statistics(Planes image, std::size_t count)
{
    constexpr double floor = 1e-3;
    std::array<float, 12> result;
    for (int c = 0; c < 3; ++c) {
        std::vector<float> values(image.plane(c), image.plane(c) + count);
        double sum = 0, log_sum = 0;
        for (const float v : values) {
            sum += v;
            log_sum += std::log(std::max<double>(v, floor));
        }
        const double numbers[] = { std::log(std::max(sum / count, floor)), log_sum / count,
                                   std::log(std::max(quantile(values, 0.5), floor)),
                                   std::log(std::max(quantile(values, 0.98), floor)) };
        for (int i = 0; i < 4; ++i)
            result[i * 3 + c] = static_cast<float>(numbers[i] * 0.5 + 1);
    }
    return result;
}

} // namespace srisp
