// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.h"

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

/// Runs a command line that has none of our image commands: the stock oiiotool takes the place of this process. Returns
/// never, or fails.
[[noreturn]] void run_unchanged(const std::vector<Step>& steps);

/// Rewrites a command line, runs the stock oiiotool on it and cleans up. `program` is the name by which the user called
/// us. Returns the exit code; a signal that came meanwhile ends this process.
int run_rewritten(const std::string& program, const std::vector<Step>& steps);

} // namespace srisp::tool
