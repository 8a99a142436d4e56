// SPDX-License-Identifier: Apache-2.0
#include "image_statistics.h"

#include <algorithm>

#include <ATen/Parallel.h>

#include "quantile_features.h"
#include "statistics.h"

namespace srisp::train {

namespace {

/// `numbers_of(planes, height, width)` of each image, an array of `count`.
template<class Numbers> torch::Tensor numbers_of_each(const torch::Tensor& linear, int count, const Numbers& numbers_of)
{
    const torch::Tensor images = linear.detach().to(torch::kCPU, torch::kFloat32).contiguous();
    const std::int64_t height = images.size(2), width = images.size(3), pixels = height * width;
    torch::Tensor result = torch::empty({ images.size(0), count });
    float* const values = images.data_ptr<float>();
    float* const numbers = result.data_ptr<float>();
    at::parallel_for(0, images.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const auto some = numbers_of(Planes{ values + i * 3 * pixels, pixels }, static_cast<int>(height),
                                         static_cast<int>(width));
            std::copy(some.begin(), some.end(), numbers + i * count);
        }
    });
    return result.to(linear.device());
}

} // namespace

torch::Tensor image_statistics(const torch::Tensor& linear)
{
    return numbers_of_each(linear, 12, [](Planes image, int height, int width) {
        return statistics(image, static_cast<std::size_t>(height) * width);
    });
}

torch::Tensor image_quantiles(const torch::Tensor& linear)
{
    return numbers_of_each(linear, kQuantileFeatures, quantile_features);
}

torch::Tensor linear_source(const torch::Tensor& display)
{
    return display.detach().clamp_min(1e-8).pow(2.2);
}

} // namespace srisp::train
