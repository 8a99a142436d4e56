// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace srisp {

/// 32 × 32 × 32 complex values and their discrete Fourier transform, float32. Both directions work in place, leave out
/// the factor 1 / 32³, and take the least effort for convolutions: the spectrum is in an order of its own.
class CubeFft {
public:
    static constexpr int kSide = 32, kCells = kSide * kSide * kSide;

    CubeFft() : m_real(kCells), m_imaginary(kCells) {}

    /// Cell (x, y, z) is at (x · 32 + y) · 32 + z; in the spectrum, the frequencies (x, y, z) are at
    /// (place(x) · 32 + place(z)) · 32 + place(y).
    float* real() { return m_real.data(); }
    float* imaginary() { return m_imaginary.data(); }
    /// Where frequency k, 0 … 31, is along its axis: the bits of k reversed.
    static int place(int k);

    void forward();
    void inverse();

private:
    /// Transforms the 32 columns of a plane in one of the directions.
    using Columns = void (*)(float* real, float* imaginary);
    void transform_x(Columns columns);
    /// Along both other axes, which change places.
    void transform_planes(Columns columns);

    std::vector<float> m_real, m_imaginary;
};

} // namespace srisp
