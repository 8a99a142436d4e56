// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Reads a whole file of at most `max_bytes`; `where` starts every message ("model 'm.safetensors'").
Expected<std::string> read_file(const std::string& path, std::uint64_t max_bytes, const std::string& where);

/// A small text file. Errors, as `'path': reason`: missing, a folder, unreadable, more than `most` bytes.
Expected<std::string> read_text_file(const std::string& path, std::size_t most);

} // namespace srisp
