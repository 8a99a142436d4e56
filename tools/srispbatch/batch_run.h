// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "batch_options.h"

namespace srisp::tool {

/// What became of a set.
struct BatchSummary {
    std::int64_t planned = 0, made = 0, done_before = 0, failed = 0;
    double seconds = 0, megapixels = 0;
    std::map<std::string, std::int64_t> reasons; ///< of failures: the first words of their messages
    std::string failed_path;                     ///< where they are listed; empty: there are none
    bool dry = false;
};

/// Makes what is not done of a set. A failure of one photo is counted; what would fail for all (a full disk, no model,
/// no references) is a Failure. After a signal no photo is begun, and Interrupted is thrown when those under way are
/// finished.
BatchSummary run_batch(const BatchOptions& options);

/// Compares all results that a folder's manifest names with their sizes and hashes; `failed` counts what is missing or
/// differs, and names each on stderr.
BatchSummary verify_batch(const std::string& folder);

std::string summary_text(const BatchSummary& summary);
std::string summary_json(const BatchSummary& summary);

} // namespace srisp::tool
