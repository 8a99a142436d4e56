// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/expected.h>

#include "base/file_bytes.h"
#include "reference/dng_levels.h"
#include "reference/raw_pixels.h"

namespace srisp {

/// Decodes a floating point DNG (16 or 32 bits; uncompressed or Deflate) with libtiff; Debian's LibRaw can't. Errors,
/// without the file's name: other bit depths and predictors, damaged data, NaN or infinity.
Expected<RawImage> decode_float_dng(const FileBytes& file, const DngDescription& dng);

} // namespace srisp
