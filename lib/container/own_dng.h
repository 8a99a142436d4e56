// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/camera.h>

namespace srisp {

/// What a DNG says of itself that holds the record of an unprocessed photo.
struct OwnDng {
    std::string description; ///< LibRaw cuts it off
    CameraFacts facts;       ///< its as-shot neutral is that of the scene
    /// White above black, in the file's units: of R, G in the rows of R, B, G in the rows of B.
    std::array<float, 4> ranges{};
};

/// Null: the file is none, or it is damaged, which its reader will say. `named_raw`: its name is that of a RAW file; a
/// TIFF of another name, which may be huge, is looked into only where it begins as DNGs do.
std::shared_ptr<const OwnDng> find_own_dng(const std::string& path, bool named_raw);

/// Asks OpenImageIO's reader of RAW files for an unprocessed image: linear camera RGB in [0,1], black subtracted, not
/// balanced, demosaiced, as stored; in place of all that `hints` ask of it.
void ask_for_camera_rgb(const OwnDng& dng, OIIO::ImageSpec& hints);

/// Puts into the spec of an image that was asked for so what results say of themselves.
void describe_own_dng(const OwnDng& dng, OIIO::ImageSpec& spec);

} // namespace srisp
