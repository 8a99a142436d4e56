// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "eval_options.h"
#include "protocol.h"

namespace srisp::tool {

/// Evaluates all methods on all that the protocol has, several tasks at a time, and writes what is asked for: a table
/// to stdout, report, JSON and CSV. After a signal it does that with what is done, and the same command goes on from
/// there. Returns the exit code: 1 where a file could not be tested. Throws Failure: nothing could be; outputs that
/// cannot be written; Interrupted.
int run_evaluation(const EvalOptions& options, const Protocol& protocol);

} // namespace srisp::tool
