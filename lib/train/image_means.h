// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

constexpr double kDarkestMean = 1e-3; ///< as in the statistics [method 2]

/// ln of the channel means of images [N, 3, H, W], [N, 3].
inline torch::Tensor log_means(const torch::Tensor& images)
{
    return images.mean({ 2, 3 }).clamp_min(kDarkestMean).log();
}

/// What counts of the errors of log means [N, 3]: the relative error of G (which is what images differ by: twice too
/// bright is worse than half as bright), and the errors of ln R/G and ln B/G (errors of brightness are many times those
/// of colour, and would hide them in R and B). [N, 3]
inline torch::Tensor errors_of_means(const torch::Tensor& errors_of_logs)
{
    const torch::Tensor green = errors_of_logs.slice(1, 1, 2);
    return torch::cat(
        { torch::expm1(green), errors_of_logs.slice(1, 0, 1) - green, errors_of_logs.slice(1, 2, 3) - green }, 1);
}

} // namespace srisp::train
