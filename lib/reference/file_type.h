// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace srisp {

/// What may be in a reference file, judged by its first bytes.
enum class FileKind { raw, tiff, exr, display_encoded, foveon };

struct FileType {
    FileKind kind;
    std::string name; ///< of a display-encoded format, for messages ("JPEG")
};

/// How many bytes `file_type` wants to see.
constexpr std::size_t kHeadBytes = 64;

/// Judges by magic numbers alone. Whatever is not known is `raw`: LibRaw decides then.
FileType file_type(const std::string& head);

} // namespace srisp
