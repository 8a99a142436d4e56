// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "pointwise.h"

namespace srisp {

/// 12 numbers of a linear image, R, G, B each: ln(max(mean, 1e-3)); mean of ln(max(v, 1e-3)); ln(max(median, 1e-3));
/// ln(max(98th percentile, 1e-3)); all × 0.5 + 1. Quantiles interpolate linearly at q (count − 1). [method 2]
std::array<float, 12> statistics(Planes image, std::size_t count);

/// Quantiles of the values, which it reorders, interpolated linearly at q (n − 1). Asked in ascending order of q, since
/// each search leaves out what lies below the last. At least one value.
class Quantiles {
public:
    explicit Quantiles(std::vector<float>& values) : m_values(values), m_begin(values.begin()) {}
    double operator()(double q);

private:
    std::vector<float>& m_values;
    std::vector<float>::iterator m_begin; ///< nothing before it is larger than what follows
};

} // namespace srisp
