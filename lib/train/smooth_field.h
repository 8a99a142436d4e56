// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "random_tensors.h"

namespace srisp::train {

/// Random smooth fields [N, 1, H, W] on a device, each of mean 0 and deviation 1: sums of four octaves of cubic
/// B-splines over normal numbers, each octave twice as fine and 0.6 as strong as the last. Uneven light is exp(σ ·
/// field).
torch::Tensor smooth_fields(Randoms& randoms, std::int64_t height, std::int64_t width, const torch::Device& device);

} // namespace srisp::train
