// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>
#include <srisp/image_input.h>
#include <srisp/options.h>

namespace srisp {

/// The thumbnail of a photo: any image that OpenImageIO reads, or one in memory, taken as display-encoded sRGB (colour
/// profiles are converted, linear values encoded), upright. Read in bands, so that the image itself need not be in
/// memory. Of the options `input`, `gain_map`, `allow_partial` and `threads` count. `cancelled`: asked now and then;
/// true ends it. Threads: safe. Errors start with "photo 'path': ": missing, no image, damaged, nothing that can be a
/// photo.
SRISP_API Expected<Thumbnail> load_photo_thumbnail(const ImageInput& photo, const Options& options = {},
                                                   const std::function<bool()>& cancelled = {});

} // namespace srisp
