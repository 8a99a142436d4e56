// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// A small text file. Errors, as `'path': reason`: missing, a folder, unreadable, more than `most` bytes.
Expected<std::string> read_text_file(const std::string& path, std::size_t most);

/// Writes to a temporary name in the same folder and renames it when complete. Errors, as `'path': reason`.
Status write_text_file(const std::string& path, const std::string& text);

/// Path and state (device, inode, size, modification time in ns) of a file: a key for what was made from it. Only the
/// path where there is no such file.
std::string file_state(const std::string& path);

} // namespace srisp
