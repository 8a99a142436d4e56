// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "torch_api.h"

namespace srisp::train {

/// clamp01(v + φ(v)) with kernels of its own for every image: image [N, 3, H, W]; per layer weight [N, O, I, k, k] and
/// bias [N, O]; ReLU between; each layer replicates the edge of its input [P 3.2, method 1].
torch::Tensor apply_tone_map(const torch::Tensor& image, const std::vector<torch::Tensor>& weight,
                             const std::vector<torch::Tensor>& bias);

} // namespace srisp::train
