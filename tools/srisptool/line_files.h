// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "command_line.h"

namespace srisp::tool {

/// Fails where a line with commands of ours would write onto a file that they read: an image (before its output; a line
/// may write an image and then read it), a reference, a model, a file of parameters, a recipe and what that names. Of a
/// sequence each frame that is on disk counts. What only the stock oiiotool reads may be written to, as with it.
void refuse_inputs_as_outputs(const std::vector<Step>& steps);

} // namespace srisp::tool
