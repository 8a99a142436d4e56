// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace srisp::tool {

/// What the command line asks for.
struct EvalOptions {
    enum class Job { help, version, half_split, pairs, unpaired, compare };
    Job job = Job::help;

    std::vector<std::string> inputs;     ///< RAW files, photos, a CSV file, files of scores
    std::vector<std::string> references; ///< of unpaired photos
    std::vector<std::string> models, baselines{ "gain_match", "upi" };
    std::vector<std::string> renderings{ "fixed", "random", "camera" };
    std::vector<std::string> methods; ///< that are compared: NAME, or NAME=OTHER; empty: those that both files have
    std::string report, json, csv;    ///< files; json "-": stdout
    int size = 512;                   ///< longest side on which is measured; 0: as it is
    int edits = 5;
    int reference_count = 8; ///< that each unpaired photo gets
    int pictures = 100;      ///< images that the report shows, at most
    double report_mb = 18;   ///< size of the report, about
    std::uint64_t seed = 1;
    int threads = 0;
    double memory_gb = 0;
    bool by_camera = false, quiet = false;
};

/// Reads the command line. Throws Failure for wrong usage.
EvalOptions read_options(int argc, char** argv);

/// What srispeval --help prints.
extern const char kHelp[];

} // namespace srisp::tool
