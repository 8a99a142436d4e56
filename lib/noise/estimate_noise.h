// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/expected.h>
#include <srisp/noise.h>

#include "reference/raw_pixels.h"

namespace srisp {

/// The noise of a RAW image, from itself; `pixels` must have passed check_filters and check_levels.
///
/// The sites of each place of the filter pattern are a plane of one colour, which is cut into blocks of 16 × 16. Blocks
/// with values at black's or white's end are left out. A block's variance is that of its second differences along both
/// directions (1 −2 1; −2 4 −2; 1 −2 1), which any sum of a function of x and one of y leaves untouched: slopes, and
/// black levels of rows and columns. Its texture is how far the means of its 4 × 4 parts lie from a plane; the noise in
/// them is another than that in the differences, so that choosing by one does not make the other too small. Blocks are
/// sorted into bins of brightness; of each bin those count that noise alone may have made, and of these the least
/// textured third. A line is fitted to the lowest tenths of the bins' variances, with little weight for bins that lie
/// far off, and then, again and again, to all blocks that do not lie far above it: texture can only add. Both are
/// corrected by what they are in pure noise.
///
/// What fine, strong texture everywhere leaves in it is some 10 % in shot noise; read noise is less certain where it is
/// small against the shot noise of the darkest blocks.
///
/// Errors, which say why it is not possible: three channels (demosaicing has mixed the noise of neighbours); a colour
/// with too few flat blocks, with too small a range of brightness, or whose variance does not grow with it.
Expected<NoiseModel> estimate_noise(const RawPixels& pixels, int threads = 0);

} // namespace srisp
