// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace srisp::tool {

/// A private folder (mode 700) that goes away with this object. Its lock is held while this process or a child that
/// inherited it lives, so that the next run can tell the folders of killed runs and remove them.
class TemporaryFolder {
public:
    /// Makes `.srisptool.partial-…` (base/unfinished.h) under $TMPDIR, else /tmp, else /dev/shm, whose name must hold
    /// nothing that oiiotool would scan (`#`, `@`, `%`, `{`, …). Removes leftovers there first.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return m_path; }

private:
    std::filesystem::path m_path;
    int m_lock = -1;
};

/// Removes the folder and the outputs that are listed in it, as far as they are this user's and have the name of an
/// unfinished one: whoever made the folder, nothing else goes.
void remove_temporary_folder(const std::filesystem::path& folder);

/// In a temporary folder: the outputs that the guard saw being made, each ended by a NUL (output_guard.cpp).
constexpr char kStartedOutputs[] = "started_outputs";

} // namespace srisp::tool
