// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "random_tensors.h"
#include "torch_api.h"

namespace srisp::train {

/// The four cameras of the Darmstadt Noise Dataset as UPI uses them (Brooks et al. 2019): linear sRGB → camera RGB,
/// rows sum to 1, [4, 3, 3].
torch::Tensor dnd_rgb_to_camera();

/// White-balanced camera RGB → linear sRGB of `count` of them for each image, in random order, [N, count, 3, 3]: what
/// pictures may be rendered with where no cameras are measured.
torch::Tensor dnd_color_matrices(int count, Randoms& randoms);

} // namespace srisp::train
