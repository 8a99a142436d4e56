// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bake_options.h"
#include "bake_report.h"

namespace srisp::tool {

/// Chooses, bakes, measures and writes; nothing is written where something fails before. Throws Failure, Interrupted.
BakeSummary bake(const BakeOptions& options);

} // namespace srisp::tool
