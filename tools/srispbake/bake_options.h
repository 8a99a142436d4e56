// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <srisp/apply.h>
#include <srisp/ocio_transform.h>

#include "../common/common_options.h"

namespace srisp::tool {

/// What the command line asks for.
struct BakeOptions : CommonOptions {
    std::string reference, source, parameters, model = "default", output;
    std::string direction; ///< of a single file: "unprocess", "process" or "develop"
    int lut_size = kDefaultLut;
    std::string fragment;                            ///< a config to be extended
    std::string linear_srgb;                         ///< the name of that colour space in it; empty: found by itself
    std::string brightness;                          ///< EV, or "sample"; empty: as it was chosen
    std::uint64_t seed = 0;                          ///< of a sampled brightness
    std::string white_balance, exposure, highlights; ///< of the development; empty: the defaults
    bool cube = false, watch = false, allow_partial = false;
};

/// Makes the parser; it fills `options`.
void describe_options(CLI::App& app, BakeOptions& options);

/// What the options say of a development: into ACES2065-1. Throws Failure: values that are none.
Options development_options(const BakeOptions& options);

/// Throws Failure where options contradict each other or what is needed is missing.
void check_options(const BakeOptions& options);

/// What srispbake --help prints.
extern const char kHelp[];

/// What a file does.
enum class BakeKind {
    unprocess, ///< photo to camera RGB
    process,   ///< back
    develop    ///< camera RGB to ACES2065-1
};

/// "unprocess", "process" or "develop".
const char* kind_name(BakeKind kind);

/// One file to be written.
struct OutputName {
    std::string path;
    BakeKind kind;
    bool cube; ///< .cube instead of .clf
};

/// Whether -o names one file (".clf", ".cube", a device or pipe) instead of what a pair of names starts with.
bool is_single_file(const std::string& output);

/// The files that are asked for. `output`: as -o has it, or empty: beside the reference, or in the folder
/// SRISP_BAKE_PATH where the reference's cannot be written to. Throws Failure: no folder to write to.
std::vector<OutputName> output_names(const std::string& reference, const std::string& output,
                                     const std::string& direction, bool cube);

/// Throws Failure if the file at `path` is a bake of another reference than `reference` (an absolute path): in
/// SRISP_BAKE_PATH those of two folders may have one name.
void refuse_bake_of_another(const std::string& path, const std::string& reference);

/// The line of a bake's description that tells its reference, an absolute path, and names no folder:
/// "Reference: ref.dng, in the folder xxh64:0123456789abcdef".
std::string reference_line(const std::string& reference);

} // namespace srisp::tool
