// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/image.h>

#include "reference/raw_pixels.h"

namespace srisp {

/// The thumbnail of a sensor image, as stored (not yet upright). A mosaic needs no demosaic: per colour the area
/// average over that colour's own sites; sensors under 512 px (a cell may hold no site of a colour) are demosaiced
/// bilinearly first. Same bits for any number of threads. [method: thumbnails]
Thumbnail raw_thumbnail(const RawPixels& pixels);

} // namespace srisp
