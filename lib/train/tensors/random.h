// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.h"
#include "train/tensors/torch_api.h"

namespace srisp::train {

using srisp::Random;

/// One generator for each image of a batch.
using Randoms = std::vector<Random>;

/// The generators of one purpose of all images.
Randoms fork(const Randoms& randoms, std::uint64_t purpose);

/// One number for each image as [N, 1, 1, 1], ready to be multiplied with images; `draw` gets each image's generator.
template<class Draw> torch::Tensor per_image(Randoms& randoms, const torch::Device& device, Draw draw)
{
    auto values = torch::empty({ static_cast<std::int64_t>(randoms.size()), 1, 1, 1 });
    float* value = values.data_ptr<float>();
    for (Random& random : randoms)
        *value++ = static_cast<float>(draw(random));
    return values.to(device);
}

/// Nearly normal noise of mean 0 and deviation 1, [N, sizes…] on the CPU: sums of four uniform numbers, which are far
/// cheaper than normal ones and end at ±3.46.
torch::Tensor noise(Randoms& randoms, at::IntArrayRef sizes);

/// Random smooth fields [N, 1, H, W] on a device, each of mean 0 and deviation 1: sums of four octaves of cubic
/// B-splines over normal numbers, each octave twice as fine and 0.6 as strong as the last. Uneven light is exp(σ ·
/// field).
torch::Tensor smooth_fields(Randoms& randoms, std::int64_t height, std::int64_t width, const torch::Device& device);

} // namespace srisp::train
