// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace srisp {

/// IEEE 754 binary16 → float32, exact, subnormals and infinities included. (Imath has this too, but the model file must
/// be readable where there is no Imath.)
float float_from_half(std::uint16_t bits);

/// float32 → the nearest IEEE 754 binary16, ties to even; beyond ±65504 (rounded) it is infinite, NaN stays NaN.
std::uint16_t half_from_float(float value);

/// bfloat16 → float32, exact.
float float_from_bfloat16(std::uint16_t bits);

} // namespace srisp
