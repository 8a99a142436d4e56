// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

/// The half split of N images [N, 3, H, W]: what is right of the middle, top and bottom, is unprocessed with what is
/// left of it as reference. Crops 2n and 2n + 1 belong to image n. A middle row or column of odd sizes is left out.
/// [P 4.3]
torch::Tensor left_halves(const torch::Tensor& images);    ///< [N, 3, H, W / 2]
torch::Tensor right_quarters(const torch::Tensor& images); ///< [2N, 3, H / 2, W / 2]

} // namespace srisp::train
