// SPDX-License-Identifier: Apache-2.0
#include "half_split.h"

namespace srisp::train {

torch::Tensor left_halves(const torch::Tensor& images)
{
    return images.slice(3, 0, images.size(3) / 2).contiguous();
}

torch::Tensor right_quarters(const torch::Tensor& images)
{
    const auto height = images.size(2), width = images.size(3);
    const auto right = images.slice(3, width - width / 2, width);
    const auto top = right.slice(2, 0, height / 2), bottom = right.slice(2, height - height / 2, height);
    return torch::stack({ top, bottom }, 1).flatten(0, 1).contiguous();
}

} // namespace srisp::train
