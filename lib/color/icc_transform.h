// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <srisp/expected.h>

#include "color/color_transform.h"

namespace srisp {

/// The transform of an embedded ICC profile to display-encoded sRGB, relative colorimetric; null where the profile is
/// sRGB itself (is_identity). `channels`: colour channels of the image, 1 or 3. Errors:
/// damaged, or its colour space does not fit the image (CMYK, Lab, …).
Expected<ColorTransformPtr> color_transform_from_icc(const void* profile, std::size_t size, int channels);

} // namespace srisp
