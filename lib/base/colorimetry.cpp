// SPDX-License-Identifier: Apache-2.0
#include "base/colorimetry.h"

#include <cmath>

namespace srisp {

double srgb_curve(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_curve_back(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Vector3 xyz_of(const Xy& xy)
{
    return { xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1] };
}

Xy xy_of(const Vector3& xyz)
{
    const float sum = xyz[0] + xyz[1] + xyz[2];
    return { xyz[0] / sum, xyz[1] / sum };
}

Matrix3 primaries_matrix(const Chromaticities& c)
{
    // Directions only, so that a y of 0 is allowed.
    return { c[0], c[2], c[4], c[1], c[3], c[5], 1 - c[0] - c[1], 1 - c[2] - c[3], 1 - c[4] - c[5] };
}

Matrix3 rgb_to_xyz(const Chromaticities& chromaticities)
{
    const Matrix3 primaries = primaries_matrix(chromaticities);
    return product(primaries, diagonal(product(inverse(primaries), xyz_of(white_of(chromaticities)))));
}

Matrix3 adaptation(const Xy& from_white, const Xy& to_white)
{
    constexpr Matrix3 bradford{ 0.8951f, 0.2664f, -0.1614f, -0.7502f, 1.7135f, 0.0367f, 0.0389f, -0.0685f, 1.0296f };
    const Vector3 from = product(bradford, xyz_of(from_white)), to = product(bradford, xyz_of(to_white));
    const Matrix3 scale = diagonal({ to[0] / from[0], to[1] / from[1], to[2] / from[2] });
    return product(inverse(bradford), product(scale, bradford));
}

} // namespace srisp
