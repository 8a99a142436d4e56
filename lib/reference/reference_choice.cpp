// SPDX-License-Identifier: Apache-2.0
#include <srisp/reference.h>

#include <filesystem>

#include "base/hashes.h"
#include "reference/camera_files.h"

namespace srisp {

Expected<std::string> choose_reference(const std::string& pattern, std::uint64_t seed, const std::string& photo_name)
{
    try {
        const auto files = expand_reference(pattern);
        if (!files)
            return files.error();
        const std::string name = std::filesystem::path(photo_name).filename().string();
        return (*files)[std::size_t(seeded_hash(seed, name) % files->size())];
    } catch (const std::exception& failed) {
        return Error{ "reference '" + pattern + "': " + failed.what() };
    }
}

} // namespace srisp
