// SPDX-License-Identifier: Apache-2.0
#include "features/sums.h"

#include "features/lanes.h"

namespace srisp {

/// Σ term(i)
template<class Term> inline __attribute__((always_inline)) double add_up(std::size_t count, const Term& term)
{
    double sums[kLanes] = {};
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes)
        for (int k = 0; k < kLanes; ++k)
            sums[k] += term(i + k);
    for (; i < count; ++i)
        sums[0] += term(i);
    for (int k = 1; k < kLanes; ++k)
        sums[0] += sums[k];
    return sums[0];
}

SRISP_WIDE_LANES double sum_of(const float* values, std::size_t count)
{
    return add_up(
        count, [&](std::size_t i) __attribute__((always_inline)) { return double(values[i]); });
}

SRISP_WIDE_LANES double product_of(const float* a, const float* b, std::size_t count)
{
    return add_up(
        count, [&](std::size_t i) __attribute__((always_inline)) { return double(a[i]) * b[i]; });
}

} // namespace srisp
