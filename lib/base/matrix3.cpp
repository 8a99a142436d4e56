// SPDX-License-Identifier: Apache-2.0
#include "base/matrix3.h"

namespace srisp {

/// Cofactor of element (row, column).
static double cofactor(const Matrix3& m, int row, int column)
{
    const int r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    return double(m[r1 * 3 + c1]) * m[r2 * 3 + c2] - double(m[r1 * 3 + c2]) * m[r2 * 3 + c1];
}

Matrix3 product(const Matrix3& a, const Matrix3& b)
{
    Matrix3 result{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            for (int k = 0; k < 3; ++k)
                result[row * 3 + column] += a[row * 3 + k] * b[k * 3 + column];
    return result;
}

double determinant(const Matrix3& m)
{
    return m[0] * cofactor(m, 0, 0) + m[1] * cofactor(m, 0, 1) + m[2] * cofactor(m, 0, 2);
}

Matrix3 inverse(const Matrix3& m)
{
    const double scale = 1 / determinant(m);
    Matrix3 result;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            result[row * 3 + column] = static_cast<float>(cofactor(m, column, row) * scale);
    return result;
}

Matrix3 row_normalized(const Matrix3& m)
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
