// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "samples.h"
#include "unprocessor.h"

namespace srisp::train {

struct AnchorFitSettings {
    int pairs = 4096;
    double ridge = 1e-3;

    template<class Visitor> void describe(Visitor& v)
    {
        v.integer("pairs", pairs, 32, 1'000'000, "training pairs that the anchor is fitted to before the first step");
        v.number("ridge", ridge, 0, 1e3, "penalty on the squared weights, per pair");
    }
};

/// A linear regression of the RAW's log channel means on the statistics of source and reference [method 2].
struct AnchorFit {
    torch::Tensor weight, bias;      ///< [3, 24], [3]
    double deviation = 0;            ///< of the error of ln mean, root of its mean square over pairs and channels
    double gain_match_deviation = 0; ///< the same where the reference's means are taken for the RAW's
};

/// Ridge regression in closed form: `statistics` [n, 24], source's then reference's; `truth_means` [n, 3]. n ≥ 2.
AnchorFit fit_anchor(const torch::Tensor& statistics, const torch::Tensor& truth_means, double ridge);

/// Fits the model's anchor to pseudo pairs of the first steps; nothing where the model has none.
std::optional<AnchorFit> start_anchor(Unprocessor& model, Samples& samples, const AnchorFitSettings& settings);

} // namespace srisp::train
