// SPDX-License-Identifier: Apache-2.0
#include "tone_map_network.h"

namespace srisp::train {

namespace {

/// All images in one grouped convolution: x is [1, N · I, H, W], the result [1, N · O, H, W].
torch::Tensor convolve_each(torch::Tensor x, const torch::Tensor& weight, const torch::Tensor& bias)
{
    const std::int64_t images = weight.size(0), kernel = weight.size(-1);
    if (kernel == 3)
        x = torch::replication_pad2d(x, { 1, 1, 1, 1 });
    return torch::conv2d(x, weight.flatten(0, 1), bias.flatten(), torch::IntArrayRef{ 1 }, torch::IntArrayRef{ 0 },
                         torch::IntArrayRef{ 1 }, images);
}

} // namespace

torch::Tensor apply_tone_map(const torch::Tensor& image, const std::vector<torch::Tensor>& weight,
                             const std::vector<torch::Tensor>& bias)
{
    torch::Tensor x = image.reshape({ 1, -1, image.size(2), image.size(3) });
    for (std::size_t l = 0; l < weight.size(); ++l) {
        x = convolve_each(x, weight[l], bias[l]);
        if (l + 1 < weight.size())
            x = torch::relu(x);
    }
    return (image + x.view(image.sizes())).clamp(0, 1);
}

} // namespace srisp::train
