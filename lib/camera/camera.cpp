// SPDX-License-Identifier: Apache-2.0
#include <srisp/camera.h>

namespace srisp {

const CameraFacts::ColorMatrix* CameraFacts::daylight_matrix() const
{
    constexpr int kD65 = 21; // EXIF LightSource
    for (const ColorMatrix& matrix : color_matrices)
        if (matrix.illuminant == kD65)
            return &matrix;
    return color_matrices.empty() ? nullptr : &color_matrices.front();
}

bool CameraFacts::has_integer_levels() const
{
    return white_level >= 255 && white_level <= 65535;
}

} // namespace srisp
