// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bake_errors.h"
#include "options.h"
#include "output_names.h"

namespace srisp::tool {

/// A file that was written, and how far off it is.
struct BakeReport {
    OutputName name;
    std::size_t bytes;
    BakeErrors errors;
    std::vector<std::string> sentences; ///< the errors in words, as in the file's description
};

/// What was baked, and from what.
struct BakeSummary {
    std::string photo, full_model; ///< what errors were measured on; empty where there was none
    std::vector<BakeReport> files;
};

/// Chooses, bakes, measures and writes; nothing is written where something fails before. Throws Failure, Interrupted.
BakeSummary bake(const Options& options);

} // namespace srisp::tool
