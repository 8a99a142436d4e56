// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"
#include <srisp/image.h>

namespace srisp::train {

/// Views of images [N, 3, H, W] for the functions of the library, which take interleaved channels.
class InterleavedImages {
public:
    explicit InterleavedImages(const torch::Tensor& images)
        : m_values(images.to(torch::kCPU, torch::kFloat32).permute({ 0, 2, 3, 1 }).contiguous())
    {
    }

    ImageView operator[](std::int64_t n) const
    {
        const auto height = static_cast<int>(m_values.size(1)), width = static_cast<int>(m_values.size(2));
        return { m_values.data_ptr<float>() + n * height * width * 3, width, height, 3, std::ptrdiff_t(3) * width };
    }

private:
    torch::Tensor m_values;
};

} // namespace srisp::train
