// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace srisp {

/// Quantiles of some values, interpolated linearly at q (n − 1). At least one value, none of them NaN.
class Quantiles {
public:
    explicit Quantiles(std::vector<float> values);
    double operator()(double q) const;

private:
    std::vector<float> m_sorted;
};

} // namespace srisp
