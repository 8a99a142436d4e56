// SPDX-License-Identifier: Apache-2.0
#include "tone_map_network.h"

#include "relu_with_border.h"

namespace srisp::train {

namespace {

// oneDNN computes 8 outputs three times as fast as 3, with their gradients.
constexpr std::int64_t kFewestOutputs = 8;

/// `x`, [1, N · I, H + 2, W + 2], has its border already; all images go through one grouped convolution.
torch::Tensor convolve_3x3(const torch::Tensor& x, const torch::Tensor& weight, const torch::Tensor& bias)
{
    return torch::conv2d(x, weight.flatten(0, 1), bias.flatten(), torch::IntArrayRef{ 1 }, torch::IntArrayRef{ 0 },
                         torch::IntArrayRef{ 1 }, weight.size(0));
}

/// 1×1 kernels as the middle of 1×3 ones: oneDNN hands the 1×1 grouped convolution to BLAS, and Debian's reference BLAS
/// takes five times as long.
torch::Tensor convolve_1x1(const torch::Tensor& x, const torch::Tensor& weight, const torch::Tensor& bias)
{
    const torch::Tensor wide = torch::constant_pad_nd(weight, { 1, 1 });
    return torch::conv2d(x, wide.flatten(0, 1), bias.flatten(), torch::IntArrayRef{ 1 }, torch::IntArrayRef{ 0, 1 },
                         torch::IntArrayRef{ 1 }, weight.size(0));
}

} // namespace

torch::Tensor apply_tone_map(const torch::Tensor& image, const std::vector<torch::Tensor>& weight,
                             const std::vector<torch::Tensor>& bias)
{
    const std::int64_t images = image.size(0), height = image.size(2), width = image.size(3);
    const bool spatial = weight.front().size(-1) == 3;
    torch::Tensor x = image.reshape({ 1, -1, height, width });
    if (spatial)
        x = torch::replication_pad2d(x, { 1, 1, 1, 1 });
    for (std::size_t l = 0; l < weight.size(); ++l) {
        torch::Tensor w = weight[l], b = bias[l];
        if (const std::int64_t missing = kFewestOutputs - w.size(1); missing > 0) {
            w = torch::constant_pad_nd(w, { 0, 0, 0, 0, 0, 0, 0, missing });
            b = torch::constant_pad_nd(b, { 0, missing });
        }
        x = spatial ? convolve_3x3(x, w, b) : convolve_1x1(x, w, b);
        if (l + 1 < weight.size())
            x = spatial ? relu_with_border(x) : torch::relu(x);
    }
    return (image + x.view({ images, -1, height, width }).narrow(1, 0, 3)).clamp(0, 1);
}

} // namespace srisp::train
