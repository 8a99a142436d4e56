// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

/// The four cameras of the Darmstadt Noise Dataset as UPI uses them (Brooks et al. 2019): linear sRGB → camera RGB,
/// rows sum to 1, [4, 3, 3].
torch::Tensor dnd_rgb_to_camera();

} // namespace srisp::train
