// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <srisp/ocio_transform.h>

#include "../common/common_options.h"

namespace srisp::tool {

/// What the command line asks for.
struct BakeOptions : CommonOptions {
    std::string reference, source, parameters, model = "pointwise", output;
    std::string direction; ///< of a single file: "unprocess" or "process"
    int lut_size = kDefaultLut;
    std::string fragment;    ///< a config to be extended
    std::string linear_srgb; ///< the name of that colour space in it; empty: found by itself
    bool cube = false, watch = false;
};

/// Makes the parser; it fills `options`.
void describe_options(CLI::App& app, BakeOptions& options);

/// Throws Failure where options contradict each other or what is needed is missing.
void check_options(const BakeOptions& options);

/// What srispbake --help prints.
extern const char kHelp[];

} // namespace srisp::tool
