// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

/// Smooth (bicubic) enlargement of [N, C, h, w].
inline torch::Tensor enlarge(const torch::Tensor& images, std::int64_t height, std::int64_t width)
{
    return torch::upsample_bicubic2d(images, { height, width }, /* align_corners */ false);
}

} // namespace srisp::train
