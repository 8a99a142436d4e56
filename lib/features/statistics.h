// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "base/planes.h"

namespace srisp {

/// 12 numbers of a linear image, R, G, B each: ln(max(mean, 1e-3)); mean of ln(max(v, 1e-3)); ln(max(median, 1e-3));
/// ln(max(98th percentile, 1e-3)); all × 0.5 + 1. Quantiles interpolate linearly at q (count − 1). [method 2]
std::array<float, 12> statistics(Planes image, std::size_t count);

} // namespace srisp
