// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Linear light in [0,1] → display-encoded sRGB (IEC 61966-2-1), by a table; within 5e-7. Values outside are clipped.
float srgb_encoded(float linear);

/// Colours of an embedded ICC profile → display-encoded sRGB, relative colorimetric. Immutable.
class ColorTransform {
public:
    virtual ~ColorTransform() = default;
    /// In place, 3 floats per pixel in [0,1] (grey: three equal ones). Results outside [0,1] are clipped; returns how
    /// many.
    virtual std::int64_t apply(float* rgb, std::int64_t pixels) const = 0;
};

/// The transform of a profile; null where it is sRGB itself (no colour moves by half an 8-bit step). `channels`: colour
/// channels of the image, 1 or 3. Errors: damaged, or its colour space does not fit the image (CMYK, Lab, …).
Expected<std::shared_ptr<const ColorTransform>> color_transform_from_icc(const void* profile, std::size_t size,
                                                                         int channels);

} // namespace srisp
