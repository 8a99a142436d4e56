// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <srisp/parameters.h>

#include "../common/file_list.h"
#include "batch_options.h"
#include "reference_set.h"

namespace srisp::tool {

/// One file to be made.
struct BatchTask {
    ListedFile photo;
    int copy = 0;
    std::string reference;
    std::uint64_t seed = 0;                       ///< of noise, a sampled brightness and a random crop
    std::string output;                           ///< relative to the output folder
    std::optional<ListedFile> shot;               ///< the photo whose parameters hold, where folders are shots
    std::uint64_t shot_seed = 0;                  ///< its seed
    std::shared_ptr<const Parameters> parameters; ///< recorded ones, instead of chosen ones; null: none
};

/// What is to be made.
struct BatchPlan {
    std::vector<BatchTask> tasks;     ///< of this shard
    std::vector<std::string> outputs; ///< of all shards
};

/// All files of a shard, in the order of their names. A result is named after its photo, with the number of the copy
/// where a photo has several: `street/0001.exr`, `street/0001_2.exr`. Which reference and seed it gets depends on the
/// seed, the photo's name and the copy's number alone; where folders are shots, on their first photo's name. Which
/// shard it belongs to: assign_shards. Throws Failure: two photos whose results would have one name; those of
/// ReferenceSet::of.
BatchPlan plan_batch(const std::vector<ListedFile>& photos, const ReferenceSet& references,
                     const BatchOptions& options);

} // namespace srisp::tool
