// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "operators.h"

namespace srisp {

/// Appends the gain < 1 that rebuilds clipped highlights, gain · (u + m (max(u) − u)), u = min(v, 1 / gain),
/// m = clamp01((Σ min(u, 1) − 2.9) / 0.1)², for white-balanced values v of at most `most`: curves that spread 0.9 … 1,
/// where m bends, over most of a cube, and the cube. Below 0.9 in any channel m is 0, and the table exact; above 1 it
/// is linear in each channel.
void append_rebuilt_highlights(Operators& operators, double gain, double most);

} // namespace srisp
