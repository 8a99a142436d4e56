// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/reference.h>

#include "reference/raw_pixels.h"

namespace srisp {

/// All of a reference but its name and path. `hash`: of what the image was decoded from.
Reference reference_of(const RawImage& image, const std::string& hash);

/// The same from a RAW file. `isolate`: it is read and decoded in a process of its own (decoder_process.h). Errors,
/// without the file's name: it cannot be read; those of decode_raw; those of that process.
Expected<Reference> load_raw(const std::string& path, bool isolate);

} // namespace srisp
