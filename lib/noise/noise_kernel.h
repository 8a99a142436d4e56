// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "noise/philox.h"

// The arithmetic of noise, vectorised and dispatched at run time; no fused operations, so the same bits on every
// instruction set. One counter of Philox serves four pixels of a row that begin where x is a multiple of 4.

namespace srisp {

constexpr int kNoiseBlock = 1024; // pixels
constexpr int kNoiseSlack = 256;  // more that may be touched; their values do not matter
constexpr int kNoiseBuffer = kNoiseBlock + kNoiseSlack;

/// Pixels of a row whose first x is a multiple of 4, and that are kNoiseBlock at most.
struct NoiseBlock {
    std::uint64_t seed;
    int x, y, count;
    const float *shot, *read; ///< variance of each pixel, kNoiseBuffer numbers
};

/// Random words of the block's pixels: kNoiseBuffer numbers.
void random_words(const NoiseBlock& block, NoiseStream stream, std::uint32_t* target);

/// Standard normal numbers by Box and Muller, of at most 6.7 in size: kNoiseBuffer numbers.
void normal_numbers(const NoiseBlock& block, float* target);

/// Adds noise to a block of kNoiseBuffer finite values; false, and nothing done, where one of the first `count` is not.
bool add_block_noise(const NoiseBlock& block, float* values);

} // namespace srisp
