// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "operators.h"

namespace srisp {

/// Appends the gain < 1 that rebuilds clipped highlights (lib/src/pointwise.h) of white-balanced values, which are at
/// most `most`: curves that spread 0.9 … 1, where the formula bends, and what is above over nearly all of a cube, and
/// the cube. Below 0.9 in any channel values are multiplied by the gain alone, and the table is exact.
void append_rebuilt_highlights(Operators& operators, double gain, double most);

} // namespace srisp
