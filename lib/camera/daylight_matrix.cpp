// SPDX-License-Identifier: Apache-2.0
#include "camera/daylight_matrix.h"

namespace srisp {

const CameraFacts::ColorMatrix* daylight_matrix(const CameraFacts& facts)
{
    constexpr int kD65 = 21; // EXIF LightSource
    for (const CameraFacts::ColorMatrix& matrix : facts.color_matrices)
        if (matrix.illuminant == kD65)
            return &matrix;
    return facts.color_matrices.empty() ? nullptr : &facts.color_matrices.front();
}

} // namespace srisp
