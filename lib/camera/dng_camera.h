// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/camera.h>

namespace srisp {

class TiffTags;
struct TiffFolder;

/// Fills the facts of camera and exposure from a DNG's tags: make, model, orientation, colour matrices (with analog
/// balance and camera calibration), as-shot neutral, noise profile, ISO, exposure time, f-number. `image`: the folder
/// of the main image, which may hold some of them.
void describe_dng_camera(const TiffTags& tags, const TiffFolder& image, CameraFacts& facts);

} // namespace srisp
