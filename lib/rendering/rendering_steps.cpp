// SPDX-License-Identifier: Apache-2.0
#include "rendering/rendering_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace srisp {

float quantile(std::vector<float> values, double q)
{
    const auto at = values.begin() + std::lround(q * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

Matrix3 mixed_matrix(const std::vector<Matrix3>& matrices, int mixed, Random random)
{
    // The first numbers of a random order, with normalised exponentials as weights.
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < matrices.size(); ++k)
        order.emplace_back(random.uniform(), k);
    std::sort(order.begin(), order.end());
    order.resize(std::min(order.size(), std::size_t(mixed)));
    double sum = 0;
    for (auto& [weight, k] : order)
        sum += weight = -std::log(1 - random.uniform()) + 1e-9;
    Matrix3 result{};
    for (const auto& [weight, k] : order)
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] += float(weight / sum) * matrices[k][i];
    return result;
}

} // namespace srisp
