// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/camera.h>

namespace srisp {

/// A camera's matrix for D65, else its first one; null where it has none.
const CameraFacts::ColorMatrix* daylight_matrix(const CameraFacts& facts);

} // namespace srisp
