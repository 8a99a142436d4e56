// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// A file's bytes; shared, so that what was decoded in place can keep them.
struct FileBytes {
    std::shared_ptr<const unsigned char[]> data;
    std::size_t size = 0;
};

/// The first bytes of a file (at most `limit`). Errors, without the file's name: missing, unreadable, a folder, not a
/// regular file, empty.
Expected<std::string> read_head(const std::string& path, std::size_t limit);

/// The whole file, read once. The same errors, and files of more than 2 GiB (no RAW file is that large).
Expected<FileBytes> read_whole_file(const std::string& path);

} // namespace srisp
