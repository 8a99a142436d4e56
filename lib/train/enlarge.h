// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <torch/torch.h>

namespace srisp::train {

/// Smooth (bicubic) enlargement of [N, C, h, w].
inline torch::Tensor enlarge(const torch::Tensor& images, std::int64_t height, std::int64_t width)
{
    namespace F = torch::nn::functional;
    return F::interpolate(images, F::InterpolateFuncOptions()
                                      .size(std::vector<std::int64_t>{ height, width })
                                      .mode(torch::kBicubic)
                                      .align_corners(false));
}

} // namespace srisp::train
