// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// The bytes of the JPEG picture that a camera put into its RAW file, the largest one that LibRaw finds. `isolate`: as
/// in load_reference. Errors, without the file's name: it has none, or none that is a JPEG; those of
/// check_libraw_traps, what LibRaw says.
Expected<std::string> embedded_preview(const std::string& path, bool isolate);

} // namespace srisp
