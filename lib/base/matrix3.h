// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace srisp {

/// 3×3, row-major; column vectors.
using Matrix3 = std::array<float, 9>;

/// Linear sRGB → XYZ, D65. [IEC 61966-2-1]
constexpr Matrix3 kSrgbToXyz{ 0.4124564f, 0.3575761f, 0.1804375f, 0.2126729f, 0.7151522f,
                              0.0721750f, 0.0193339f, 0.1191920f, 0.9503041f };

/// a · b: b first, then a.
Matrix3 product(const Matrix3& a, const Matrix3& b);

double determinant(const Matrix3& m);

/// The inverse, computed in double; m must not be singular.
Matrix3 inverse(const Matrix3& m);

/// Each row divided by its signed sum, which must not be 0.
Matrix3 row_normalized(const Matrix3& m);

} // namespace srisp
