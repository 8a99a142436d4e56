// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session.h"

namespace srisp::tool {

/// Trains to the end, or until a signal comes; the exit code.
int train_model(Session& session, const TrainOptions& options);

/// Says on stdout what train_model would do, and how long it would take; the exit code.
int rehearse(Session& session, const TrainOptions& options);

/// Tests a method that has nothing to learn; the exit code.
int test_only(Session& session, const TrainOptions& options);

} // namespace srisp::tool
