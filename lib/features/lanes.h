// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>

// Eight numbers at once, by the compilers' own vectors: the trainer has no other library for it. Values go by
// reference, since how they are passed would depend on the instruction set.

/// A function that is compiled for AVX2, too, and chosen by the processor. Same bits: neither contracts to FMA. Nothing
/// in it may throw, so it takes memory that is there: GCC 12 loses track of where exceptions go from such a function.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(SRISP_SANITIZED)
#define SRISP_WIDE_LANES __attribute__((target_clones("avx2", "default")))
#else
#define SRISP_WIDE_LANES
#endif

namespace srisp {

constexpr int kLanes = 8;
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));
typedef std::int32_t IntLanes __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

inline __attribute__((always_inline)) void load(const float* from, Lanes& to)
{
    std::memcpy(&to, from, sizeof to);
}
inline __attribute__((always_inline)) void store(const Lanes& from, float* to)
{
    std::memcpy(to, &from, sizeof from);
}
/// x = max(x, least)
inline __attribute__((always_inline)) void raise(Lanes& x, float least)
{
    const Lanes lowest = least - Lanes{};
    x = x > lowest ? x : lowest;
}
/// x = min(x, most)
inline __attribute__((always_inline)) void limit(Lanes& x, float most)
{
    const Lanes highest = most - Lanes{};
    x = x < highest ? x : highest;
}

/// x = ln x, of normal numbers above 0; within 2e-7 of max(1, |ln x|). (As Cephes has it.)
inline __attribute__((always_inline)) void take_log(Lanes& x)
{
    IntLanes bits;
    std::memcpy(&bits, &x, sizeof bits);
    IntLanes exponent = (bits >> 23) - 126;
    bits = (bits & 0x007fffff) | 0x3f000000;
    Lanes m;
    std::memcpy(&m, &bits, sizeof m); // 0.5 ≤ m < 1
    const IntLanes small = m < 0.707106781f;
    exponent += small; // −1 where it is so
    m = small ? m + m - 1.0f : m - 1.0f;
    const Lanes e = __builtin_convertvector(exponent, Lanes), z = m * m;
    Lanes y = m * 7.0376836292e-2f - 1.1514610310e-1f;
    y = y * m + 1.1676998740e-1f;
    y = y * m - 1.2420140846e-1f;
    y = y * m + 1.4249322787e-1f;
    y = y * m - 1.6668057665e-1f;
    y = y * m + 2.0000714765e-1f;
    y = y * m - 2.4999993993e-1f;
    y = y * m + 3.3333331174e-1f;
    y = y * m * z - e * 2.12194440e-4f - z * 0.5f;
    x = m + y + e * 0.693359375f;
}

/// x = exp x, of −87 to 88 (beyond: as at the end); within 2e-7 (relative). (As Cephes has it.)
inline __attribute__((always_inline)) void take_exp(Lanes& x)
{
    raise(x, -87);
    limit(x, 88);
    const Lanes power = x * 1.44269504089f;
    const IntLanes n = __builtin_convertvector(power < 0.0f ? power - 0.5f : power + 0.5f, IntLanes);
    const Lanes whole = __builtin_convertvector(n, Lanes);
    x = x - whole * 0.693359375f + whole * 2.12194440e-4f;
    Lanes y = x * 1.9875691500e-4f + 1.3981999507e-3f;
    y = y * x + 8.3334519073e-3f;
    y = y * x + 4.1665795894e-2f;
    y = y * x + 1.6666665459e-1f;
    y = y * x + 5.0000001201e-1f;
    y = y * x * x + x + 1.0f;
    const IntLanes scale_bits = (n + 127) << 23;
    Lanes scale;
    std::memcpy(&scale, &scale_bits, sizeof scale);
    x = y * scale;
}

} // namespace srisp
