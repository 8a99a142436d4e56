// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "image_compare.h"
#include "train/tensors/torch_api.h"
#include <doctest/doctest.h>

/// All elements in order, as float32.
inline std::vector<float> values_of(const torch::Tensor& tensor)
{
    const torch::Tensor flat = tensor.detach().to(torch::kFloat32).contiguous();
    return { flat.data_ptr<float>(), flat.data_ptr<float>() + flat.numel() };
}

/// The largest size of an element.
inline double largest(const torch::Tensor& tensor)
{
    return tensor.abs().max().item<double>();
}

/// Interleaved RGB, height × width, as [1, 3, height, width].
inline torch::Tensor planar(const std::vector<float>& rgb, std::int64_t height, std::int64_t width)
{
    return torch::tensor(rgb).view({ 1, height, width, 3 }).permute({ 0, 3, 1, 2 }).contiguous();
}

/// The first image of [N, 3, H, W] as interleaved RGB.
inline std::vector<float> interleaved(const torch::Tensor& images)
{
    return values_of(images[0].permute({ 1, 2, 0 }));
}

/// Images with values in [low, high) that are smooth like photos, not noise: a coarse random grid enlarged.
inline torch::Tensor smooth_images(std::int64_t count, std::int64_t height, std::int64_t width, std::uint64_t seed,
                                   double low = 0, double high = 1)
{
    const torch::Tensor grid =
        torch::empty({ count, 3, 5, 5 }).uniform_(low, high, at::detail::createCPUGenerator(seed));
    return torch::upsample_bilinear2d(grid, { height, width }, false).contiguous();
}
