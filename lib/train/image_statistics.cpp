// SPDX-License-Identifier: Apache-2.0
#include "image_statistics.h"

#include <algorithm>

#include <ATen/Parallel.h>

#include "statistics.h"

namespace srisp::train {

torch::Tensor image_statistics(const torch::Tensor& linear)
{
    const torch::Tensor images = linear.detach().to(torch::kCPU, torch::kFloat32).contiguous();
    const std::int64_t pixels = images.size(2) * images.size(3);
    torch::Tensor result = torch::empty({ images.size(0), 12 });
    float* const values = images.data_ptr<float>();
    float* const numbers = result.data_ptr<float>();
    at::parallel_for(0, images.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const auto twelve =
                srisp::statistics({ values + i * 3 * pixels, pixels }, static_cast<std::size_t>(pixels));
            std::copy(twelve.begin(), twelve.end(), numbers + i * 12);
        }
    });
    return result.to(linear.device());
}

torch::Tensor source_statistics(const torch::Tensor& display)
{
    return image_statistics(display.detach().clamp_min(1e-8).pow(2.2));
}

} // namespace srisp::train
