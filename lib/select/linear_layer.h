// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/model_data.h"

namespace srisp {

/// weight · x + bias; sums in double.
std::vector<float> transformed(const Linear& layer, const std::vector<float>& x);

/// The elements of `a`, then those of `b`.
std::vector<float> concatenated(std::vector<float> a, const std::vector<float>& b);

/// exp(x) / Σ exp(x), computed in double without overflow.
std::vector<float> softmax(const std::vector<float>& x);

} // namespace srisp
