// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

#include "batch_plan.h"

namespace srisp::tool {

/// The reason in an error for a disk that is full, which ends a run.
constexpr char kDiskFull[] = "No space left on device";

/// Called with the bytes that making an image will take, as its header says, before they are taken; may wait.
using AskForMemory = std::function<void(std::uint64_t)>;

/// Makes one file of a set, whole or not at all, and gives the line for its manifest. `path`: where it goes.
/// `settings`: hash of what is the same for all. A file of that name that has the same bytes already stays as it is;
/// another one is an error unless it `may_replace` it.
Expected<nlohmann::ordered_json> run_task(const BatchTask& task, const std::string& path, const MakingOptions& options,
                                          const std::string& settings, bool may_replace, const AskForMemory& ask);

/// Before the first image of a process: one thread for each, the writer of `format`, and how many references are kept.
void prepare_making(OutputFormat format, std::size_t most_references);

} // namespace srisp::tool
