// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/matrix3.h"

namespace srisp {

/// Linear light in [0,1] → display-encoded sRGB (IEC 61966-2-1), by a table; within 5e-7. Values outside are clipped.
float srgb_encoded(float linear);
/// The way back; values in [0,1].
float srgb_decoded(float encoded);

/// Colours as an image stores them → display-encoded sRGB, or camera RGB. Immutable.
class ColorTransform {
public:
    virtual ~ColorTransform() = default;
    /// In place, 3 floats per pixel (grey: three equal ones). Results outside [0,1] are clipped; returns how many.
    virtual std::int64_t apply(float* rgb, std::int64_t pixels) const = 0;
    /// Whether values may be any finite number; otherwise they must be in [0,1].
    virtual bool takes_unbounded() const { return false; }
};
using ColorTransformPtr = std::shared_ptr<const ColorTransform>;

/// Clips to [0,1]; whether that changed more than rounding of a profile's numbers does (one 8-bit step is 0.004).
inline bool clip(float& value)
{
    const bool outside = value < -0.002f || value > 1.002f;
    value = value > 0 ? (value < 1 ? value : 1) : 0;
    return outside;
}

/// A curve over [0,1], sampled so that every 16-bit code value is a sample, linear between them.
class CurveTable {
public:
    explicit CurveTable(const std::function<double(double)>& curve);
    /// `value` in [0,1].
    float operator()(float value) const
    {
        const float position = value * kSteps;
        const int index = position < kSteps ? static_cast<int>(position) : kSteps - 1;
        return m_samples[index] + (position - index) * (m_samples[index + 1] - m_samples[index]);
    }

private:
    static constexpr int kSteps = 65535;
    std::vector<float> m_samples;
};

/// Curves from stored values in [0,1] to linear light, then a matrix to linear sRGB. Little CMS needs 300 ns per pixel
/// for these in float, and errs by 0.05 at the border of the gamut in its fast 16-bit form (measured with Display P3);
/// this needs 20 ns.
ColorTransformPtr curves_and_matrix(std::array<CurveTable, 3> to_linear, const Matrix3& to_linear_srgb);

/// Linear light of any size, then a matrix to linear sRGB.
ColorTransformPtr linear_matrix(const Matrix3& to_linear_srgb);

/// Linear light of any size, then a matrix to linear values in [0,1]; nothing is encoded.
ColorTransformPtr plain_matrix(const Matrix3& matrix);

/// Whether no colour moves by three quarters of an 8-bit step: the commonest sRGB profile (Hewlett-Packard's of 1998,
/// whose numbers are rounded) moves pure green by 0.51. `channels`: of colour in the image, 1 or 3.
bool is_identity(const ColorTransform& transform, int channels);

} // namespace srisp
