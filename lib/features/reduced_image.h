// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "base/planes.h"

namespace srisp {

/// Three planes whose rows have no gaps.
struct PlanarImage {
    Planes planes;
    int height, width;
};

/// R, G and B of the pixels of a small image, row by row.
using ReducedImage = std::array<std::vector<float>, 3>;

/// Means over blocks of max(1, height / 64) × max(1, width / 64) pixels, whole blocks only: about 64 × 64 of them, so
/// that images of all sizes give about the same numbers.
ReducedImage reduced(const PlanarImage& image);

} // namespace srisp
