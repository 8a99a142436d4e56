// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace srisp::tool {

/// The running program's file, links resolved.
std::filesystem::path own_executable();

/// The folder with the plugin: `lib/srisp` (or lib/<multiarch>/srisp, lib64/srisp) beside the folder of the program, in
/// the build tree and under any prefix. Fails with the folders that were looked in.
std::filesystem::path plugin_folder();

} // namespace srisp::tool
