// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace srisp {

/// 3×3, row-major; column vectors.
using Matrix3 = std::array<float, 9>;
using Vector3 = std::array<float, 3>;

/// Linear sRGB → XYZ, D65. [IEC 61966-2-1]
constexpr Matrix3 kSrgbToXyz{ 0.4124564f, 0.3575761f, 0.1804375f, 0.2126729f, 0.7151522f,
                              0.0721750f, 0.0193339f, 0.1191920f, 0.9503041f };

/// Cofactor of element (row, column).
inline double cofactor(const Matrix3& m, int row, int column)
{
    const int r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    return double(m[r1 * 3 + c1]) * m[r2 * 3 + c2] - double(m[r1 * 3 + c2]) * m[r2 * 3 + c1];
}

/// a · b: b first, then a.
inline Matrix3 product(const Matrix3& a, const Matrix3& b)
{
    Matrix3 result{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            for (int k = 0; k < 3; ++k)
                result[row * 3 + column] += a[row * 3 + k] * b[k * 3 + column];
    return result;
}

inline Vector3 product(const Matrix3& m, const Vector3& v)
{
    Vector3 result;
    for (int row = 0; row < 3; ++row)
        result[row] = m[row * 3] * v[0] + m[row * 3 + 1] * v[1] + m[row * 3 + 2] * v[2];
    return result;
}

inline Matrix3 diagonal(const Vector3& v)
{
    return { v[0], 0, 0, 0, v[1], 0, 0, 0, v[2] };
}

inline double determinant(const Matrix3& m)
{
    return m[0] * cofactor(m, 0, 0) + m[1] * cofactor(m, 0, 1) + m[2] * cofactor(m, 0, 2);
}

/// The inverse, computed in double; m must not be singular.
inline Matrix3 inverse(const Matrix3& m)
{
    const double scale = 1 / determinant(m);
    Matrix3 result;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            result[row * 3 + column] = static_cast<float>(cofactor(m, column, row) * scale);
    return result;
}

/// Each row divided by its signed sum, which must not be 0.
inline Matrix3 row_normalized(const Matrix3& m)
{
    Matrix3 result = m;
    for (int row = 0; row < 3; ++row) {
        const float sum = m[row * 3] + m[row * 3 + 1] + m[row * 3 + 2];
        for (int column = 0; column < 3; ++column)
            result[row * 3 + column] /= sum;
    }
    return result;
}

} // namespace srisp
