// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>
#include <srisp/expected.h>
#include <srisp/ocio_transform.h>

namespace srisp {

/// What both OpenColorIO and CLF know, one after the other.

/// min(max(v, low), high)
struct Clamp {
    float low, high;
};
/// min(v, high)
struct Limit {
    float high;
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

using Operator = std::variant<Clamp, Limit, Power, Affine, Curves, Cube>;
using Operators = std::vector<Operator>;

inline Affine diagonal(double r, double g, double b)
{
    return { { r, 0, 0, 0, g, 0, 0, 0, b } };
}

/// Appends the highlight-preserving inverse gain v · max(m + (1 − m) s, s), m = clamp01((mean(v) − 0.9) / 0.1)², for
/// values from 0 to `most` per channel, and raises `most` to what can come out. A plain matrix where every s ≥ 1.
/// Otherwise a matrix to (grey, R − grey, B − grey), curves that spread grey 0.9 … 1 and the differences that occur
/// there over nearly all of a cube, and the cube: what the formula is outside of these is linear, and exact. [method 1]
void append_inverse_gain(Operators& operators, const std::array<float, 3>& scales, std::array<float, 3>& most);

/// Appends the gain < 1 that rebuilds clipped highlights (kernels/pointwise.h) of white-balanced values, which are at
/// most `most`: curves that spread 0.9 … 1, where the formula bends, and what is above over nearly all of a cube, and
/// the cube. Below 0.9 in any channel values are multiplied by the gain alone, and the table is exact.
void append_rebuilt_highlights(Operators& operators, double gain, double most);

/// The whole pipeline [method 1]; limits and errors as make_ocio_transform says.
Expected<Operators> pipeline_operators(const Model& model, const Parameters& parameters, Direction direction,
                                       int lut_size);

/// A development [srisp/develop.h]; highlights are not Highlights::blend.
Operators development_operators(const Development& development);

/// The operators as OpenColorIO's transforms. Throws what OpenColorIO throws.
OCIO_NAMESPACE::GroupTransformRcPtr ocio_group(const Operators& operators);

/// A CLF file. (OpenColorIO writes them, too, but takes seconds for a cube of 65³.)
std::string clf_text(const Operators& operators, const ClfLabel& label);

/// A text inside of a CLF file. What XML cannot hold (control characters) becomes '?', bytes that are no UTF-8 \xff.
std::string clf_escaped(const std::string& text);

} // namespace srisp
