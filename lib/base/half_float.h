// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace srisp {

/// IEEE 754 binary16 → float32, exact, subnormals and infinities included. (Imath has this too, but the model file must
/// be readable where there is no Imath.)
inline float float_from_half(std::uint16_t bits)
{
    const int exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    float magnitude;
    if (exponent == 31)
        magnitude = mantissa ? NAN : INFINITY;
    else if (exponent == 0)
        magnitude = std::ldexp(static_cast<float>(mantissa), -24);
    else
        magnitude = std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
    return bits & 0x8000 ? -magnitude : magnitude;
}

/// float32 → the nearest IEEE 754 binary16, ties to even; beyond ±65504 (rounded) it is infinite, NaN stays NaN.
inline std::uint16_t half_from_float(float value)
{
    const auto sign = static_cast<std::uint16_t>(std::signbit(value) ? 0x8000 : 0);
    const float magnitude = std::abs(value);
    if (std::isnan(value))
        return sign | 0x7e00;
    if (magnitude >= 65520.0f) // halfway between the largest half and the next power of two
        return sign | 0x7c00;
    if (magnitude == 0)
        return sign;
    int exponent = 0;
    std::frexp(magnitude, &exponent); // magnitude = m · 2^exponent, m in [0.5, 1)
    // Halves of this magnitude are multiples of 2^(exponent − 11); subnormal ones, of 2^−24.
    const int step = std::max(exponent - 11, -24);
    const auto multiple = static_cast<std::uint16_t>(std::nearbyint(std::ldexp(magnitude, -step)));
    // The bits of adjacent halves are adjacent numbers, so a multiple rounded up to 2048 carries into the exponent.
    return sign | static_cast<std::uint16_t>(multiple + ((step + 24) << 10));
}

/// bfloat16 → float32, exact.
inline float float_from_bfloat16(std::uint16_t bits)
{
    const std::uint32_t wide = static_cast<std::uint32_t>(bits) << 16;
    float value;
    std::memcpy(&value, &wide, sizeof value);
    return value;
}

} // namespace srisp
