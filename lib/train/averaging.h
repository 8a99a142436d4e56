// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "torch_api.h"

namespace srisp::train {

/// Moves the moving average of vectors on by the `values` of step `step` (from 0): decay min(1 − 1/(step + 1), limit),
/// so that the first value counts in full and the first steps average evenly [P 3.3].
inline void average_into(torch::Tensor average, const torch::Tensor& values, std::int64_t step, double limit)
{
    const torch::NoGradGuard no_gradient;
    const double decay = std::min(1 - 1 / (static_cast<double>(step) + 1), limit);
    average.lerp_(values, 1 - decay);
}

} // namespace srisp::train
