// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/tensors/random.h"

namespace srisp::train {

/// ISP_rand, method.md section 4, with the additions of the second series of section 6. What the method does not name
/// is off by default: shares of 0.
struct RandomIspSettings {
    double true_white_balance = 0.5, white_balance_error = 0.04;
    double auto_exposure = 0.75, lowest_target = 0.5, highest_target = 1.2;
    double average_metering = 0, lowest_average = 0.08, highest_average = 0.3;
    double lowest_gain = 1, highest_gain = 2;
    bool neutral_highlights = false;
    int mixed_matrices = 3;
    double linear_saturation = 0, lowest_saturation = 0.7, highest_saturation = 1.4;
    double shoulder = 0, lowest_shoulder = 0.4, highest_shoulder = 0.9;
    double lowest_gamma = 2.0, highest_gamma = 3.2;
    std::string smoothstep = "random";
    double smoothstep_share = 0.4;
    double local_contrast = 0, lowest_contrast = -0.4, highest_contrast = 0.5;
    double channel_curves = 0, channel_bend = 0.25;

    template<class Visitor> void describe(Visitor& v)
    {
        v.number("true_white_balance", true_white_balance, 0, 1, "share balanced by the light; the rest: grey world");
        v.number("white_balance_error", white_balance_error, 0, 0.5, "error of a true balance's gains, ± this part");
        v.number("auto_exposure", auto_exposure, 0, 1, "share exposed for the picture; the rest get a random gain");
        v.range("target", lowest_target, highest_target, 0.01, 5, "where auto exposure puts the 97th percentile");
        v.number("average_metering", average_metering, 0, 1, "share of auto exposures that place the mean instead");
        v.range("average", lowest_average, highest_average, 0.01, 1, "where these put the mean, linear");
        v.range("gain", lowest_gain, highest_gain, 0.1, 50, "random gain");
        v.flag("neutral_highlights", neutral_highlights,
               "clip after white balance, too: gains below 1 then leave clipped highlights grey, as cameras do");
        v.integer("mixed_matrices", mixed_matrices, 1, 10, "how many other cameras' matrices are mixed");
        v.number("saturated", linear_saturation, 0, 1, "share with another saturation, before the gamma");
        v.range("saturation", lowest_saturation, highest_saturation, 0, 4, "that saturation");
        v.number("shoulder", shoulder, 0, 1, "share whose highlights are rolled off instead of clipped");
        v.range("shoulder_start", lowest_shoulder, highest_shoulder, 0, 0.99, "linear value at which that begins");
        v.range("gamma", lowest_gamma, highest_gamma, 1, 6, "display = linear^(1/gamma)");
        v.choice("smoothstep", smoothstep, { "never", "always", "random" }, "S-curve 3v² − 2v³ at the end");
        v.number("smoothstep_share", smoothstep_share, 0, 1, "share that gets it when random");
        v.number("local_contrast", local_contrast, 0, 1, "share with local contrast");
        v.range("local_contrast_strength", lowest_contrast, highest_contrast, -1, 3,
                "part of the difference to the neighbourhood that is added");
        v.number("channel_curves", channel_curves, 0, 1, "share with a curve of its own for each channel");
        v.number("channel_bend", channel_bend, 0, 0.9, "largest bend b of these curves, v + b v (1 − v)");
    }
};

/// Renders RAW images [N, 3, H, W] in [0, 1], each whole, to display-encoded 8 bit values in [0, 1]. `white_balance`
/// [N, 3] is the true one; `matrices` [N or 1, K, 3, 3] are candidates, white-balanced camera RGB → linear sRGB, of
/// which min(K, mixed_matrices) are mixed with random weights that sum to 1.
torch::Tensor render_random(const RandomIspSettings& settings, const torch::Tensor& raw,
                            const torch::Tensor& white_balance, const torch::Tensor& matrices, Randoms& randoms);

/// A random convex mix of `mixed` of each image's candidates [N or 1, K, 3, 3], of all where there are fewer: [N, 3,
/// 3]. The weights are drawn evenly over the simplex.
torch::Tensor mix_matrices(const torch::Tensor& candidates, int mixed, const Randoms& randoms);

/// Renders for a fixed target: true white balance, highlights clipped to grey, the channel mean's 97th percentile at
/// `target` (N numbers or one), the matrix [N, 3, 3], sRGB's curve, 8 bit. The gain is limited to [1/64, 64].
torch::Tensor render_fixed(const torch::Tensor& raw, const torch::Tensor& white_balance, const torch::Tensor& matrix,
                           const torch::Tensor& target);

} // namespace srisp::train
