// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace srisp {

/// What an image file is, judged by its first bytes. `headerless`: nothing that could not be plain samples, too.
enum class FileKind { raw, tiff, exr, display_encoded, foveon, headerless };

struct FileType {
    FileKind kind;
    std::string name;   ///< of a display-encoded format, for messages ("JPEG")
    std::string reader; ///< OpenImageIO's for it; empty: none
};

/// How many bytes `file_type` wants to see.
constexpr std::size_t kHeadBytes = 64;

/// Judges by magic numbers alone. `raw` are those by which LibRaw knows a camera's file: where it finds none, it
/// guesses a camera by the file's size. `file_size`: one camera's header repeats it; 0: not known.
FileType file_type(const std::string& head, std::uint64_t file_size = 0);

/// Whether `file_type` knows files of this reader of OpenImageIO's.
bool is_told_by_first_bytes(const std::string& reader);

} // namespace srisp
