// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "unprocessor.h"

namespace srisp::train {

/// The reverse pass with a given choice: tone map (where it has one), gamma, colour, white balance, gain, clamp.
torch::Tensor reverse_pipeline(const torch::Tensor& source, const Choice& choice);

/// The forward pass with the same choice; `white_stays_white`: gains below 1 rebuild clipped highlights.
torch::Tensor forward_pipeline(const torch::Tensor& raw, const Choice& choice, bool white_stays_white);

} // namespace srisp::train
