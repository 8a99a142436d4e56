// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace srisp {

// OpenImageIO 2.4 writes no orientation into PNG files, but all texts of an image. So the orientation goes there as a
// text of just the length of the chunk that readers look for, eXIf, and becomes that when the file is whole.

/// The name of the text.
constexpr char kPngOrientationKey[] = "srisp:Orientation";
/// What follows its one digit.
constexpr char kPngOrientationRest[] = ".......";

/// Makes an eXIf chunk of that text in a PNG file. A file that is no PNG or lacks the text, or cannot be written, stays
/// as it is. Leaves errno alone.
void place_png_orientation(const char* path);

/// The same in the bytes of a file.
void place_png_orientation(std::vector<unsigned char>& bytes);

} // namespace srisp
