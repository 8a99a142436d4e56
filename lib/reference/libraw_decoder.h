// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/expected.h>

#include "base/file_bytes.h"
#include "reference/dng_levels.h"
#include "reference/raw_pixels.h"

namespace srisp {

/// Decodes a RAW file with LibRaw. `dng`: its description if it is a DNG, which then decides all but the samples; else
/// null. Errors, without the file's name: nothing that LibRaw knows, truncated or damaged data, sensors that are not
/// RGB mosaics, data that are no sensor values any more. Threads: safe.
Expected<RawImage> decode_with_libraw(const FileBytes& file, const DngDescription* dng);

} // namespace srisp
