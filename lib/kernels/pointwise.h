// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "base/matrix3.h"
#include "base/planes.h"

namespace srisp {

// The blocks of the pipeline that look at one pixel at a time. `count` pixels, from `in` to `out`, which may be
// the same planes; vectorised, dispatched at run time. Up to kRowSlack floats past the end of each plane are read and
// written (finite values, which do not matter), so rows come with that much room. pow is within 1e-6 (relative).

/// clamp01(v)
void clamp01(Planes in, Planes out, std::size_t count);
/// max(v, floor)^exponent; floor > 0
void power(Planes in, Planes out, std::size_t count, float exponent, float floor);
/// clamp01(M v)
void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& matrix);
/// Highlight-preserving inverse gain, scales s = 1 / g, unclamped (Brooks et al. 2019): v · max(m + (1 − m) s, s) with
/// m = clamp01((mean(v) − 0.9) / 0.1)².
void inverse_gain(Planes in, Planes out, std::size_t count, const float scales[3]);
/// `inverse_gain`, then `power`. Of several gains for one image: `powers` are the image's own, so that only highlights
/// take powers of each gain.
void power_of_inverse_gain(Planes in, Planes powers, Planes out, std::size_t count, const float scales[3],
                           float exponent, float floor);
/// Interleaved RGB to planes, and back. Exactly `count` pixels of the interleaved side are touched.
void split_channels(const float* rgb, Planes out, std::size_t count);
void join_channels(Planes in, float* rgb, std::size_t count);

/// The same in plain C++ with std::pow: what the vectorised forms are tested against.
namespace scalar {
void power(Planes in, Planes out, std::size_t count, float exponent, float floor);
void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& matrix);
void inverse_gain(Planes in, Planes out, std::size_t count, const float scales[3]);
} // namespace scalar

} // namespace srisp
