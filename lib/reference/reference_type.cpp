// SPDX-License-Identifier: Apache-2.0
#include "reference/reference_type.h"

#include <filesystem>

#include "base/file_bytes.h"
#include "recipe/reference_pattern.h"

namespace srisp {

Expected<FileType> reference_type(const std::string& path)
{
    const auto head = read_head(path, kHeadBytes);
    if (!head)
        return head.error();
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(path, unknown);
    const FileType type = file_type(*head, unknown ? 0 : size);
    const bool described = type.kind == FileKind::display_encoded && has_raw_extension(path) &&
                           std::filesystem::exists(layout_paths(path).front(), unknown);
    return described ? FileType{ FileKind::headerless, "", "" } : type;
}

} // namespace srisp
