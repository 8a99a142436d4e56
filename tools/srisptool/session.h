// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "command_line.h"

namespace srisp::tool {

/// Runs a command line that has none of our image commands: the stock oiiotool takes the place of this process. Returns
/// never, or fails.
[[noreturn]] void run_unchanged(const std::vector<Step>& steps);

/// Rewrites a command line, runs the stock oiiotool on it and cleans up. `program` is the name by which the user called
/// us. Returns the exit code; a signal that came meanwhile ends this process.
int run_rewritten(const std::string& program, const std::vector<Step>& steps);

} // namespace srisp::tool
