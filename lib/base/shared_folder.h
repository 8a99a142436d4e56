// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace srisp {

/// `share/srisp/<name>` beside the library, plugin or program that this code is in; empty where there is none. The
/// install tree and the build tree have the same layout, so no path is compiled in and both can be moved.
std::filesystem::path shared_folder(const std::string& name);

} // namespace srisp
