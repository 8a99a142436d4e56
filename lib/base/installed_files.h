// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

// What is installed with the library, plugin or program that this code is in. The install tree and the build tree have
// the same layout, so no path is compiled in and both can be moved.

namespace srisp {

/// `share/srisp/<name>` in the same tree; empty where there is none.
std::filesystem::path shared_folder(const std::string& name);

/// `libexec/srisp/<name>` in the same tree; empty where there is none. A file that somebody else owns or may change
/// (others than this user, root, and the owner of this code) is none.
std::filesystem::path own_program(const std::string& name);

/// Where the plugins for OpenImageIO lie beside this library; empty: they do not, or this is no library.
std::string plugins_beside();

} // namespace srisp
