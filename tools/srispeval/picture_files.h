// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

#include "pixels.h"

// Pictures as files in memory, as the report embeds them.

namespace srisp::tool {

/// A display-encoded picture as a JPEG.
Expected<std::string> jpeg_of_photo(const Pixels& photo);

/// Linear values in [0,1] as 16 bits in a PNG of 8 bits, twice as high: above the high bytes, below the low ones.
/// Values keep nine significant bits, which is finer than any of them shows, so that the file is small.
Expected<std::string> png_of_linear(const Pixels& pixels);

} // namespace srisp::tool
