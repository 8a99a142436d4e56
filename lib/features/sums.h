// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace srisp {

// In double, by sums side by side, so that none waits for the one before. The same bits on every processor.

/// Σ a
double sum_of(const float* values, std::size_t count);

/// Σ a · b
double product_of(const float* a, const float* b, std::size_t count);

} // namespace srisp
