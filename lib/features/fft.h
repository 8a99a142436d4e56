// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace srisp {

/// 32 × 32 × 32 complex values and their discrete Fourier transform, float32. Both directions work in place, leave out
/// the factor 1 / 32³, and take the least effort for convolutions: the spectrum is in an order of its own.
class CubeFft {
public:
    static constexpr int kSide = 32, kCells = kSide * kSide * kSide;
    /// From one x to the next, a cache line more than the cells of a plane: what lies 4 KB apart gets into each other's
    /// way in the cache. The floats between planes are for nothing, and stay as they are.
    static constexpr int kPlane = kSide * kSide + 16, kFloats = kSide * kPlane;

    CubeFft() : m_real(kFloats), m_imaginary(kFloats) {}

    static int at(int x, int y, int z) { return x * kPlane + y * kSide + z; }
    /// Cell (x, y, z) is at(x, y, z); in the spectrum, the frequencies (x, y, z) are at(place(x), place(z), place(y)).
    float* real() { return m_real.data(); }
    float* imaginary() { return m_imaginary.data(); }
    /// Where frequency k, 0 … 31, is along its axis: the bits of k reversed.
    static int place(int k);

    void forward();
    void inverse();

private:
    std::vector<float> m_real, m_imaginary;
};

} // namespace srisp
