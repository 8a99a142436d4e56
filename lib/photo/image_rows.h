// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

namespace srisp {

/// One picture of a file, in one size.
struct ImageLevel {
    int subimage, miplevel;
};

/// Rows y0 ≤ y < y1 of the data window (the first is 0), all channels, as values of one type without gaps, from strips
/// or tiles; `spec`: that of the level. False: the input says why.
bool read_image_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, ImageLevel level, int y0, int y1,
                     OIIO::TypeDesc type, void* rows);

} // namespace srisp
