// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pointwise.h"

namespace srisp {

/// Three planes whose rows have no gaps.
struct PlanarImage {
    Planes planes;
    int height, width;
};

/// Means of a channel over blocks of max(1, height / 64) × max(1, width / 64) pixels, whole blocks only, row by row:
/// about 64 × 64 of them, so that images of all sizes give about the same numbers.
std::vector<float> block_means(const PlanarImage& image, int channel);

} // namespace srisp
