// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace srisp {

/// Floats that kernels may read and write past the end of a row (values there do not matter, but must be finite).
constexpr int kRowSlack = 64;

/// Three planes (R, G, B) of one row or one image.
struct Planes {
    float* data;
    std::ptrdiff_t stride; ///< floats from one plane to the next

    float* plane(int channel) const { return data + channel * stride; }
};

} // namespace srisp
