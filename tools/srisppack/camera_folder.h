// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pack/training_pack_index.h"

namespace srisp::tool {

/// What cameras are simulated from.
struct CameraFolder {
    PackedCameras spectra;
    PackCamerasIndex names;
};

/// Whether a folder has `sensitivities/`.
bool is_camera_folder(const std::string& folder);

/// Reads `sensitivities/*.json` (columns R, G, B), `illuminants.csv`, `cmf_1931.json` (X, Y, Z),
/// `training_spectral.json` (measured reflectances) and, if there are any, further lights in `iso7589*.json`. Every
/// fifth camera by name is for validation. Negative values, which measurements near zero have, become 0. Fails with
/// file and reason.
CameraFolder read_camera_folder(const std::string& folder);

} // namespace srisp::tool
