// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <variant>
#include <vector>

namespace srisp {

/// What both OpenColorIO and CLF know, one after the other.

/// min(max(v, low), high)
struct Clamp {
    float low, high;
};
/// v^exponent, v ≥ 0
struct Power {
    float exponent;
};
/// M v + offset; row-major
struct Affine {
    std::array<double, 9> matrix;
    std::array<double, 3> offset{};
};
/// One curve per channel over [0,1], linear between `size` points; interleaved RGB.
struct Curves {
    int size;
    std::vector<float> rgb;
};
/// A table over the unit cube, tetrahedral between `size`³ points; interleaved RGB, the third channel runs fastest.
struct Cube {
    int size;
    std::vector<float> rgb;
};

using Operator = std::variant<Clamp, Power, Affine, Curves, Cube>;
using Operators = std::vector<Operator>;

inline Affine diagonal(double r, double g, double b)
{
    return { { r, 0, 0, 0, g, 0, 0, 0, b } };
}

} // namespace srisp
