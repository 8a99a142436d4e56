// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>

namespace srisp {

/// The thumbnail of a photo on disk: any image that OpenImageIO reads, taken as display-encoded sRGB (colour profiles
/// are converted, linear values encoded), upright. Read in bands, so that the image itself need not be in memory.
/// Threads: safe. Errors start with "photo 'path': ": missing, no image, damaged, nothing that can be a photo.
SRISP_API Expected<Thumbnail> load_photo_thumbnail(const std::string& path);

} // namespace srisp
