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

/// Mean squares of the channels of images [N, 3, H, W], [N, 3].
inline torch::Tensor mean_squares(const torch::Tensor& images)
{
    return images.square().mean({ 2, 3 });
}

/// What errors of log means [N, 3] cost, [N]: ln(1 + m / 0.2²) of the part m of the truth's squares that they miss,
/// plus ln(1 + c / 0.1²) of the squared errors c of ln R/G and ln B/G (those of brightness are many times as large, and
/// would hide them). Logs, since the mean of PSNR is one of logs: it pays to be right where the images tell the mean,
/// not a little less wrong where they do not. Below errors of 20 %, and of 10 % of colour, others count more.
inline torch::Tensor cost_of_means(const torch::Tensor& errors_of_logs, const torch::Tensor& truth_squares)
{
    constexpr double kBrightnessFloor = 0.2 * 0.2, kColorFloor = 0.1 * 0.1;
    const torch::Tensor missed =
        (truth_squares * torch::expm1(errors_of_logs).square()).sum(1) / truth_squares.sum(1).clamp_min(1e-8);
    const torch::Tensor green = errors_of_logs.select(1, 1);
    const torch::Tensor color =
        (errors_of_logs.select(1, 0) - green).square() + (errors_of_logs.select(1, 2) - green).square();
    return (missed / kBrightnessFloor).log1p() + (color / kColorFloor).log1p();
}

} // namespace srisp::train
