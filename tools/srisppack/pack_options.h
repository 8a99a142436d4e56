// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "../common/common_options.h"

namespace srisp::tool {

/// What the command line asks for.
struct PackOptions : CommonOptions {
    std::vector<std::string> inputs;                ///< recognised by what they hold
    std::vector<std::string> photos, raws, cameras; ///< taken as that
    std::string output;
    int size = 128, raw_size = 0; ///< pixels; 0: as the inputs suggest
    int crops = 3;
    std::uint64_t seed = 0;
    bool open_only = false, strict = false, replace = false;
};

/// Makes the parser; it fills `options`.
void describe_options(CLI::App& app, PackOptions& options);

/// What srisppack --help prints.
extern const char kHelp[];

} // namespace srisp::tool
