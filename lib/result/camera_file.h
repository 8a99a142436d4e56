// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "photo/pixel_source.h"

namespace srisp {

/// A camera's RAW file as linear camera RGB, 0 black and 1 saturated, as stored (`Orientation` says how it is turned),
/// demosaiced by LibRaw; its spec says what is known of the camera, as that of a RAW-like image does. `config`: the
/// host's hints, of which those for LibRaw's reader are replaced. Errors start with "image 'path': ".
Expected<std::unique_ptr<PixelSource>> open_camera_file(const std::string& path, const OIIO::ImageSpec& config,
                                                        bool isolate);

} // namespace srisp
