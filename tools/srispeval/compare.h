// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "eval_options.h"

namespace srisp::tool {

/// Holds two files of scores against each other, image by image: how far one method, or the same one in both, differs,
/// with the interval of the paired difference, and whether that is within the noise. Returns the exit code. Throws
/// Failure: files that are none, nothing in common.
int compare_evaluations(const EvalOptions& options);

} // namespace srisp::tool
