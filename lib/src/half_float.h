// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace srisp {

/// IEEE 754 binary16 → float32, exact, subnormals and infinities included. (Imath has this too, but the model file must
/// be readable where there is no Imath.)
float float_from_half(std::uint16_t bits);

/// bfloat16 → float32, exact.
float float_from_bfloat16(std::uint16_t bits);

} // namespace srisp
