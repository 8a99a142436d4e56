// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <libraw/libraw.h>
#include <srisp/camera.h>

namespace srisp {

/// Fills the facts of camera and exposure from what LibRaw read; what was assumed goes to `notes`.
void describe_camera(const libraw_data_t& data, CameraFacts& facts, std::vector<std::string>& notes);

} // namespace srisp
