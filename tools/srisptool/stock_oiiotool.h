// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace srisp::tool {

/// The stock oiiotool: $SRISP_OIIOTOOL, else the first `oiiotool` on PATH that is neither this program nor another
/// installation of it.
std::filesystem::path find_stock_oiiotool();

/// Whether a program is srisptool under one of its names: the same file, or installed as such elsewhere.
bool is_srisptool(const std::filesystem::path& program);

/// This process's environment with the plugin's folder in front of OpenImageIO's search path.
std::vector<std::string> environment_with_plugin(const std::filesystem::path& plugin_folder);

/// Sets a variable in such an environment: `name=value`; `joined` keeps the old value behind it, after a colon.
void set_variable(std::vector<std::string>& environment, const std::string& name, const std::string& value,
                  bool joined = false);

} // namespace srisp::tool
