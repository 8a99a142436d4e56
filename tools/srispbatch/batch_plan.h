// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch_options.h"
#include "photo_list.h"
#include "reference_set.h"

namespace srisp::tool {

/// One file to be made.
struct BatchTask {
    Photo photo;
    int copy = 0;
    std::string reference;
    std::uint64_t seed = 0; ///< of noise and of a sampled brightness
    std::string output;     ///< relative to the output folder
};

/// All files of a shard, in the order of their names. A result is named after its photo, with the number of the copy
/// where a photo has several: `street/0001.exr`, `street/0001_2.exr`. Which reference and seed it gets depends on the
/// seed, the photo's name and the copy's number alone; which shard it belongs to on the photo's name alone. Throws
/// Failure: two photos whose results would have one name; those of ReferenceSet::of.
std::vector<BatchTask> plan_batch(const std::vector<Photo>& photos, const ReferenceSet& references,
                                  const BatchOptions& options);

} // namespace srisp::tool
