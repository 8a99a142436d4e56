// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

namespace srisp {

/// Reads rows y0 ≤ y < y1 of the data window of one level (the first row is 0), all channels as float, tiled or not.
/// False: `input.geterror()` says why.
bool read_image_rows(OIIO::ImageInput& input, int subimage, int miplevel, int y0, int y1, float* rows);

} // namespace srisp
