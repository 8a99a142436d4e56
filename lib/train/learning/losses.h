// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "train/tensors/torch_api.h"

namespace srisp::train {

constexpr double kDarkestMean = 1e-3; ///< as in the statistics [method 2]
constexpr double kHighlight = 0.8;    ///< values above it are highlights [method 5]

/// Weights of the loss's terms. The first two are the paper's [P 3.4]; the others are ours.
struct LossSettings {
    double reverse = 1;
    double forward = 1;
    double linear = 0;
    double means = 0;
    double angle = 0;
    double highlights = 0;
    double round_trip = 0;
    double white = 0;
    bool brightness_matched = false;
    double gamma = 2.2;
    double floor = 1e-5;

    template<class Visitor> void describe(Visitor& v)
    {
        v.number("reverse", reverse, 0, 1e3, "weight of |y^(1/gamma) - y'^(1/gamma)|, truth y, prediction y'");
        v.number("forward", forward, 0, 1e3, "weight of |x - f(y)|, photo x, forward pass f of the truth");
        v.number("linear", linear, 0, 1e3, "weight of |y - y'|");
        v.number(
            "means", means, 0, 1e3,
            "weight of the errors of image means, in colour and in brightness (where there is an anchor: from what "
            "it says)");
        v.number("angle", angle, 0, 1e3, "weight of |y/|y| - y'/|y'||: about the angle between colours, in radians");
        v.number("highlights", highlights, 0, 1e3, "weight of max(0, y - y') where the truth y exceeds 0.8");
        v.number("round_trip", round_trip, 0, 1e3, "weight of |x - f(y')|");
        v.number("white", white, 0, 1e3, "weight of |x - f(y')| where the photo is clipped white");
        v.flag("brightness_matched", brightness_matched,
               "the terms reverse, linear, highlights and forward compare with the truth's mean of green: its error, "
               "which no image tells, would drown that of colour and tone");
        v.number("gamma", gamma, 1, 4, "gamma under which RAW is compared in the term 'reverse'");
        v.number("floor", floor, 1e-8, 1e-2,
                 "RAW values are raised to this before the gamma, whose slope at 0 is infinite");
    }
};

/// What a pass gave. Images [N, 3, H, W]; `processed` = f(truth) and `round_trip` = f(predicted) may be undefined where
/// the method has no forward pass or no term needs them. `expected_means` [N, 3]: the anchor's ln of the channel means;
/// undefined where there is none.
struct Compared {
    torch::Tensor source, truth, predicted, processed, round_trip, expected_means;
};

/// ln of the channel means of images [N, 3, H, W], [N, 3].
torch::Tensor log_means(const torch::Tensor& images);

/// Of the channels of images [N, 3, H, W], [N, 3 (kind), 3 (channel)]: ln of their means, means of their squares, and
/// means of their values above kHighlight, all others counted as 0. What errors of the first cost depends on the
/// others.
torch::Tensor means_of(const torch::Tensor& images);

/// What errors of log means [N, 3] cost, [N]: ln(1 + m / 0.2²) of the part m of the truth's squares that they miss,
/// plus ln(1 + c / 0.1²) of the squared errors c of ln R/G and ln B/G (those of brightness are many times as large, and
/// would hide them). Logs, since the mean of PSNR is one of logs: it pays to be right where the images tell the mean,
/// not a little less wrong where they do not. Below errors of 20 %, and of 10 % of colour, others count more.
/// Plus 60 times what highlights lose where the error is to the dark side (mean over the channels), which the best
/// guess for PSNR is where they may be clipped: it makes guesses brighter only where that costs next to nothing.
/// `truth`: as `means_of` returns them.
torch::Tensor cost_of_means(const torch::Tensor& errors_of_logs, const torch::Tensor& truth);

/// One term that is in use: its value [N] for each image, without its weight.
struct LossTerm {
    std::string name;
    double weight;
    torch::Tensor values;
};

/// Factors, [N, 1, 1, 1], that give images the mean of green of others; at most 1e3 times as bright or dark.
torch::Tensor brightness_ratio(const torch::Tensor& others, const torch::Tensor& images);

/// Whether a term compares `round_trip`.
bool needs_round_trip(const LossSettings& settings);

/// The terms with a weight above 0, in the order of the settings.
std::vector<LossTerm> loss_terms(const LossSettings& settings, const Compared& images);

} // namespace srisp::train
