// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "batch_options.h"

namespace srisp::tool {

/// Makes what is not done of a set, and reports. A failure of one photo is counted; what would fail for all (a full
/// disk, no model, no references) is a Failure. After a signal no photo is begun; those that are not finished a second
/// later are given up, and Interrupted is thrown. Returns how many failed.
std::int64_t run_batch(const BatchOptions& options);

} // namespace srisp::tool
