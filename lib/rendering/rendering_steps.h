// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <srisp/image.h>

#include "base/colorimetry.h"
#include "base/matrix3.h"
#include "base/random.h"

// What several of the renderings do.

namespace srisp {

/// Each channel times its own number.
inline Vector3 scaled(const Vector3& v, const Vector3& by)
{
    return { v[0] * by[0], v[1] * by[1], v[2] * by[2] };
}

inline float unit_clamped(float v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}
inline Vector3 unit_clamped(const Vector3& v)
{
    return { unit_clamped(v[0]), unit_clamped(v[1]), unit_clamped(v[2]) };
}
/// What a sensor clipped becomes grey once it is balanced.
inline Vector3 white_clipped(const Vector3& v)
{
    return { v[0] > 1 ? 1 : v[0], v[1] > 1 ? 1 : v[1], v[2] > 1 ? 1 : v[2] };
}

/// With sRGB's encoding.
inline Vector3 srgb_encoded(const Vector3& linear)
{
    return { float(srgb_curve(linear[0])), float(srgb_curve(linear[1])), float(srgb_curve(linear[2])) };
}

/// Part of the way from v to 3v² − 2v³.
inline float smoothstep(float v, float part)
{
    return v * (1 + part * ((3 - 2 * v) * v - 1));
}

/// One number of each pixel, in their order.
template<class Number> std::vector<float> of_pixels(ImageView image, const Number& number)
{
    std::vector<float> values;
    values.reserve(std::size_t(image.width) * std::size_t(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* p = image.pixel(x, y);
            values.push_back(number(Vector3{ p[0], p[1], p[2] }));
        }
    return values;
}

/// The value at rank round(q (count − 1)), not interpolated.
float quantile(std::vector<float> values, double q);

/// A random convex mix of `mixed` of the matrices, of all where there are fewer; weights are drawn evenly over the
/// simplex.
Matrix3 mixed_matrix(const std::vector<Matrix3>& matrices, int mixed, Random random);

} // namespace srisp
