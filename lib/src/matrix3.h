// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace srisp {

/// 3×3, row-major; column vectors.
using Matrix3 = std::array<float, 9>;

double determinant(const Matrix3& m);

/// The inverse, computed in double; m must not be singular.
Matrix3 inverse(const Matrix3& m);

/// Each row divided by its signed sum, which must not be 0.
Matrix3 row_normalized(const Matrix3& m);

} // namespace srisp
