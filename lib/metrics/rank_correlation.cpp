// SPDX-License-Identifier: Apache-2.0
#include "metrics/rank_correlation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace srisp {

/// Each value's place in the sorted list, from 0; the mean place where several are equal.
static std::vector<double> ranks(const std::vector<double>& values)
{
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
    std::vector<double> result(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]])
            ++end;
        for (std::size_t i = first; i < end; ++i)
            result[order[i]] = (first + end - 1) / 2.0;
        first = end;
    }
    return result;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    const std::vector<double> rank_a = ranks(a), rank_b = ranks(b);
    const double middle = (static_cast<double>(a.size()) - 1) / 2;
    double product = 0, square_a = 0, square_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        product += (rank_a[i] - middle) * (rank_b[i] - middle);
        square_a += (rank_a[i] - middle) * (rank_a[i] - middle);
        square_b += (rank_b[i] - middle) * (rank_b[i] - middle);
    }
    return product / std::sqrt(square_a * square_b);
}

} // namespace srisp
