// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

/// One matrix [N, 3, 3] for the colours of each image [N, 3, H, W]; on the images' device.
inline torch::Tensor transform_colors(const torch::Tensor& matrices, const torch::Tensor& images)
{
    return torch::bmm(matrices.to(images.device()), images.flatten(2)).view_as(images);
}

} // namespace srisp::train
