// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

namespace srisp {

/// A reader of WebP for ImageFile. OpenImageIO's multiplies by alpha in 8 bits whatever is asked for, leaves out
/// profile and EXIF, and decodes an animation from its start for each frame. This one takes the first frame, straight.
/// Errors: unreadable, not a whole WebP file.
Expected<std::unique_ptr<OIIO::ImageInput>> open_webp(const std::string& path);

} // namespace srisp
