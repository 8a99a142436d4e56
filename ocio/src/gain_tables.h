// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "operators.h"

namespace srisp {

/// Appends the highlight-preserving inverse gain v · max(m + (1 − m) s, s), m = clamp01((mean(v) − 0.9) / 0.1)², for
/// values from 0 to `most` per channel, and raises `most` to what can come out. A plain matrix where every s ≥ 1.
/// Otherwise a matrix to (grey, R − grey, B − grey), curves that spread grey 0.9 … 1 and the differences that occur
/// there over nearly all of a cube, and the cube: what the formula is outside of these is linear, and exact. [method 1]
void append_inverse_gain(Operators& operators, const std::array<float, 3>& scales, std::array<float, 3>& most);

/// Appends the gain < 1 that rebuilds clipped highlights (kernels/pointwise.h) of white-balanced values, which are at
/// most `most`: curves that spread 0.9 … 1, where the formula bends, and what is above over nearly all of a cube, and
/// the cube. Below 0.9 in any channel values are multiplied by the gain alone, and the table is exact.
void append_rebuilt_highlights(Operators& operators, double gain, double most);

} // namespace srisp
