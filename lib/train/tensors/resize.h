// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "train/tensors/torch_api.h"

namespace srisp::train {

/// A part of an image in fractions of its width and height: 0 ≤ left < right ≤ 1, and likewise down.
struct Window {
    double left = 0, top = 0, right = 1, bottom = 1;
};

/// Squashes images [N, C, H, W] to `height` × `width`: each output pixel is the mean of the input area that it covers,
/// fractions of pixels counted; enlarging too. Same device and type.
torch::Tensor area_resize(const torch::Tensor& images, int height, int width);

/// The same of a part of each image; one window per image.
torch::Tensor area_crop(const torch::Tensor& images, const std::vector<Window>& windows, int height, int width);

/// Smooth (bicubic) enlargement of [N, C, h, w].
inline torch::Tensor enlarge(const torch::Tensor& images, std::int64_t height, std::int64_t width)
{
    return torch::upsample_bicubic2d(images, { height, width }, /* align_corners */ false);
}

} // namespace srisp::train
