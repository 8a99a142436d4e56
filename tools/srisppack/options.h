// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace srisp {

/// What the command line asks for.
struct Options {
    std::vector<std::string> inputs;                ///< recognised by what they hold
    std::vector<std::string> photos, raws, cameras; ///< taken as that
    std::string output;
    int size = 128, raw_size = 0; ///< pixels; 0: as the inputs suggest
    int crops = 3;
    std::uint64_t seed = 0;
    int threads = 0; ///< 0: all
    bool open_only = false, strict = false, replace = false, json = false, quiet = false, help = false, version = false;
};

/// Makes the parser; it fills `options`.
void describe_options(CLI::App& app, Options& options);

} // namespace srisp
