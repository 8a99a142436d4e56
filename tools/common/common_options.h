// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace srisp::tool {

/// Options that mean the same in every tool that has them.
struct CommonOptions {
    int threads = 0; ///< 0: all
    bool json = false, quiet = false, help = false, version = false;
};

/// Adds them to `app`, without texts: those are in the tool's help text, from which its man page is made, too.
void describe_common_options(CLI::App& app, CommonOptions& options);

/// Parses the command line and prints the help text or the version where that is asked for: then false, and there is
/// nothing else to do. Throws Failure for wrong usage.
bool parse_options(CLI::App& app, const CommonOptions& options, const char* name, const char* help, int argc,
                   char** argv);

} // namespace srisp::tool
