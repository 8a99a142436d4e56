// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/matrix3.h"
#include "base/random.h"

// Unprocessing with random parameters that know neither photo nor reference. [Brooks et al. 2019]

namespace srisp {

struct UpiParameters {
    Matrix3 to_camera; ///< linear sRGB → camera RGB, a mix of the Darmstadt cameras
    Vector3 gains;     ///< white balance and gain of the forward pass, in one
};

UpiParameters draw_upi(Random random);

/// A pixel, display-encoded sRGB in [0,1], as linear camera RGB in [0,1].
Vector3 unprocessed_by_upi(const UpiParameters& parameters, const Vector3& photo);

} // namespace srisp
