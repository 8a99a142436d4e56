// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "reference/raw_pixels.h"

namespace srisp {

/// What a block of pixels of one colour shows, of values in [0,1].
struct BlockStatistics {
    float mean, variance; ///< variance: of the noise alone
    float texture;        ///< mean square of what is coarser than noise
};

/// All blocks of a mosaic that hold no clipped values, nor such that no sensor has, by colour. Order and values: the
/// same for any `threads`.
std::array<std::vector<BlockStatistics>, 3> block_statistics(const RawPixels& pixels, int threads);

/// What the variance of a block of pure noise scatters by, as a χ² of so many degrees of freedom: the variance of a sum
/// of 14 × 14 squares of differences that overlap.
constexpr double kBlockFreedom = 54;

} // namespace srisp
