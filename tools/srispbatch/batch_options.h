// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <srisp/options.h>

#include "../common/common_options.h"

namespace srisp::tool {

/// Which of several references a photo gets.
enum class Pairing {
    random,      ///< by the seed, the photo's name and the copy's number; as often as its weight says
    round_robin, ///< one after the other, along the sorted list of photos
    all,         ///< each of them
    csv          ///< the one that a CSV file names for it
};

/// What files are written.
enum class OutputFormat { exr, dng, tif, png, npy };
enum class OutputDepth { half, float32, uint16 };

/// A part of the photos, of several.
struct Shard {
    std::uint64_t index = 0, count = 1;
};

/// What decides the bytes of a result beside its photo, reference and seed.
struct MakingOptions {
    OutputFormat format = OutputFormat::exr;
    std::optional<OutputDepth> given_depth;
    OutputDepth depth = OutputDepth::half;                           ///< the given one, or what the format usually has
    std::string compression;                                         ///< as the format's writer calls it; empty: usual
    std::vector<std::pair<std::string, std::string>> image_settings; ///< what is done with each, as it was typed
    bool mosaic = false;
    bool hold = false; ///< photos of a folder are frames of a shot: the first one's parameters are those of all
    Options image;     ///< `image_settings`, read

    /// Puts together what is typed: usual values, contradictions. Throws Failure.
    void finish();
};

/// What the command line asks for.
struct BatchOptions : CommonOptions, MakingOptions {
    enum class Job { make, verify, merge, redo };

    std::vector<std::string> photos; ///< files, folders, globs, @lists, "-"
    std::string match;               ///< glob for the names of files in folders; empty: images by their endings
    std::vector<std::string> copy;   ///< globs for the names of other files in folders, which are copied
    std::string reference, output;
    Pairing pairing = Pairing::random;
    bool pairing_given = false;
    int per_image = 1;
    std::uint64_t seed = 0;
    Shard shard;
    std::int64_t photos_per_shard = 0; ///< 0: not asked for
    double memory_gb = 0;              ///< 0: a quarter of the machine's
    double time_limit = 300;           ///< seconds for a photo, isolated
    int retry = 0;                     ///< times that a photo which failed is tried again
    bool isolate = true;               ///< photos are decoded by processes of their own
    bool overwrite = false, dry_run = false, fail_fast = false, check = false;
    Job job = Job::make;
    std::string redo; ///< a result's path, or FILE.jsonl:LINE

    bool worker = false;                ///< this process makes images for another one
    std::vector<std::string> arguments; ///< the command line as it was typed, for such processes
};

/// Makes the parser; it fills `options`. What it can't check by itself, check_options does.
void describe_options(CLI::App& app, BatchOptions& options);

/// Throws Failure where options contradict each other or what is needed is missing.
void check_options(BatchOptions& options);

/// "exr", …
const char* format_name(OutputFormat format);
/// "half", "float", "uint16"
const char* depth_name(OutputDepth depth);

/// What srispbatch --help prints.
extern const char kHelp[];

} // namespace srisp::tool
