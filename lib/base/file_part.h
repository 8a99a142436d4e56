// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include <srisp/expected.h>

#include "base/regular_file.h"

namespace srisp {

/// Opens a file to be read in parts. Errors, as "'path' …": missing, unreadable, no regular file, empty.
Expected<RegularFile> open_for_parts(const std::string& path);

/// Reads `size` bytes from `offset` on. Files of any size are read so, not mapped: the mapping of a file that is made
/// shorter meanwhile would end the program. Errors, without the file's name: the disk's own; it was made shorter.
/// Threads: safe.
Status read_bytes(const RegularFile& file, void* target, std::size_t offset, std::size_t size);

} // namespace srisp
