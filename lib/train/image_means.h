// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

constexpr double kDarkestMean = 1e-3; ///< as in the statistics [method 2]
constexpr double kHighlight = 0.8;    ///< values above it are highlights [method 5]

/// ln of the channel means of images [N, 3, H, W], [N, 3].
inline torch::Tensor log_means(const torch::Tensor& images)
{
    return images.mean({ 2, 3 }).clamp_min(kDarkestMean).log();
}

/// Of the channels of images [N, 3, H, W], [N, 3 (kind), 3 (channel)]: ln of their means, means of their squares, and
/// means of their values above kHighlight, all others counted as 0. What errors of the first cost depends on the
/// others.
inline torch::Tensor means_of(const torch::Tensor& images)
{
    return torch::stack(
        { log_means(images), images.square().mean({ 2, 3 }), (images * (images > kHighlight)).mean({ 2, 3 }) }, 1);
}

/// What errors of log means [N, 3] cost, [N]: ln(1 + m / 0.2²) of the part m of the truth's squares that they miss,
/// plus ln(1 + c / 0.1²) of the squared errors c of ln R/G and ln B/G (those of brightness are many times as large, and
/// would hide them). Logs, since the mean of PSNR is one of logs: it pays to be right where the images tell the mean,
/// not a little less wrong where they do not. Below errors of 20 %, and of 10 % of colour, others count more.
/// Plus 60 times what highlights lose where the error is to the dark side (mean over the channels), which the best
/// guess for PSNR is where they may be clipped: it makes guesses brighter only where that costs next to nothing.
/// `truth`: as `means_of` returns them.
inline torch::Tensor cost_of_means(const torch::Tensor& errors_of_logs, const torch::Tensor& truth)
{
    constexpr double kBrightnessFloor = 0.2 * 0.2, kColorFloor = 0.1 * 0.1, kDarkHighlights = 60;
    const torch::Tensor squares = truth.select(1, 1), highlights = truth.select(1, 2);
    const torch::Tensor missed =
        (squares * torch::expm1(errors_of_logs).square()).sum(1) / squares.sum(1).clamp_min(1e-8);
    const torch::Tensor green = errors_of_logs.select(1, 1);
    const torch::Tensor color =
        (errors_of_logs.select(1, 0) - green).square() + (errors_of_logs.select(1, 2) - green).square();
    const torch::Tensor lost = (highlights * -torch::expm1(errors_of_logs.clamp_max(0))).mean(1);
    return (missed / kBrightnessFloor).log1p() + (color / kColorFloor).log1p() + kDarkHighlights * lost;
}

} // namespace srisp::train
