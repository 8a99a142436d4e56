// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/expected.h>

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

/// Whether a file's extension is one of a camera's RAW formats.
bool has_raw_extension(const std::string& path);

/// The files that a plain path, a folder (its RAW files, not those of folders inside), a glob or a `;` list of these
/// stand for; sorted by name, each once. Errors: none there.
Expected<std::vector<std::string>> expand_reference(const std::string& pattern);

} // namespace srisp
