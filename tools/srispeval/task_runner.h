// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "eval_options.h"
#include "journal.h"
#include "protocol.h"

namespace srisp::tool {

/// A task's name in the journal.
std::string key_of(const EvalTask& task);

/// Runs the tasks that the journal does not hold, several at a time, each result into the journal, until all are done
/// or a signal comes. Returns of which files nothing could be tested. Throws Failure: the journal cannot be written.
std::vector<LeftOut> run_tasks(const EvalOptions& options, const Protocol& protocol, const Methods& methods,
                               int picture_size, Journal& journal);

} // namespace srisp::tool
