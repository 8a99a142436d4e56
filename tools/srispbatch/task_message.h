// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "batch_plan.h"
#include "messages.h"

namespace srisp::tool {

/// What a worker is told of an image that it is to make.
struct WorkerTask {
    BatchTask task;
    std::string path;      ///< of the result
    std::string reference; ///< SharedReference::name
    std::string settings;
    bool may_replace = false;
};

/// How an answer with a line for the manifest begins, and one with an error.
constexpr char kTaskDone[] = "done", kTaskFailed[] = "failed";

Message task_message(const WorkerTask& task);
/// None: it is no such message.
std::optional<WorkerTask> task_of_message(const Message& message);

} // namespace srisp::tool
