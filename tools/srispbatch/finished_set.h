// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "batch_options.h"

// What can be done with a set that is made, from its manifest alone.

namespace srisp::tool {

/// Whether a set is complete and whole: all results that were planned are recorded, and all that are recorded have the
/// sizes and hashes that they should have. Names what does not, on stderr; returns how many.
std::int64_t verify_set(const BatchOptions& options);

/// Makes the result that `options.redo` names again, from its line in the manifest: at its place, or at
/// `options.output`. Throws Failure: no such line; photo or reference have changed; the bytes are not those that are
/// recorded.
void redo_result(const BatchOptions& options);

} // namespace srisp::tool
