// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "batch_options.h"

namespace srisp::tool {

/// Copies what `options.copy` names in the photos' folders (annotations, labels) to the same folders of the output, and
/// returns how many files that were. One that is there with the same bytes stays; another one is an error unless
/// `options.overwrite`. `results`: names of what the run makes, which are not copied onto. Throws Failure.
std::int64_t copy_files(const BatchOptions& options, const std::set<std::string>& results);

} // namespace srisp::tool
