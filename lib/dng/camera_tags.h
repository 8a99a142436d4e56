// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/camera.h>

#include "dng/tiff_folder.h"

namespace srisp {

/// Sets the tags of the camera in a DNG's first folder: its names, matrices, as-shot neutral, orientation. What is not
/// known and readers demand is neutral, and noted. The matrices of CameraFacts contain analog balance and calibration,
/// so that there are no such tags.
void set_camera_tags(const CameraFacts& facts, TiffFolderBytes& folder, std::vector<std::string>& notes);

/// The Exif folder: exposure time, f-number, ISO, as far as known.
TiffFolderBytes exif_folder(const CameraFacts& facts);

} // namespace srisp
