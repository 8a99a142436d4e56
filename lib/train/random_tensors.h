// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "random.h"
#include "torch_api.h"

namespace srisp::train {

/// One generator for each image of a batch.
using Randoms = std::vector<Random>;

/// The generators of one purpose of all images. [random.h]
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

/// Quantiles, ascending, of each row of [N, M]: the values at ranks round(q (M − 1)), not interpolated; [N] each.
std::vector<torch::Tensor> row_quantiles(const torch::Tensor& rows, const std::vector<double>& quantiles);
torch::Tensor row_quantile(const torch::Tensor& rows, double q);

} // namespace srisp::train
