// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

#include "base/input_files.h"
#include "batch_plan.h"

namespace srisp::tool {

/// The reason in an error for a disk that is full, which ends a run.
constexpr char kDiskFull[] = "No space left on device";

/// Makes one file of a set, whole or not at all, and gives the line for its manifest. `settings`: hash of what is the
/// same for all. A file of that name that has the same bytes already stays as it is; another one is an error unless
/// `options.overwrite` or `known` (it is in the manifest); one of the `inputs`, or the photo, always is.
Expected<nlohmann::ordered_json> run_task(const BatchTask& task, const BatchOptions& options,
                                          const std::string& settings, bool known, const InputFiles& inputs);

} // namespace srisp::tool
