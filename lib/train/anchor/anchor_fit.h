// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <srisp/expected.h>

#include "train/network/unprocessor.h"
#include "train/samples/samples.h"

namespace srisp::train {

/// What an anchor is fitted to: what its line and network see of the training pairs of the first steps, and what they
/// shall say. Making hundreds of thousands of them takes a quarter of an hour, so they can be kept and gone on from.
class AnchorPairs {
public:
    /// Room for `wanted` pairs, ≥ 1. `for_network`: the inputs of the anchor's network, too, not of its line alone.
    AnchorPairs(int wanted, bool for_network);

    int wanted() const { return static_cast<int>(m_inputs.size(0)); }
    int made() const { return m_made; }
    bool complete() const { return m_made == wanted(); }

    /// Makes the next few. They depend on `samples` and their number alone, not on when the ones before were made.
    void make_more(Samples& samples);

    /// Goes on from those that an object of the same kind had made; false where they cannot be its.
    bool take(const torch::Tensor& inputs, const torch::Tensor& means);

    /// Of those that are made, [n, 217], or [n, 24] for a line alone.
    torch::Tensor inputs() const { return m_inputs.slice(0, 0, m_made); }
    /// Of their RAW images, [n, 3, 3], as `means_of` returns them.
    torch::Tensor means() const { return m_means.slice(0, 0, m_made); }

private:
    torch::Tensor m_inputs, m_means;
    int m_made = 0;
};

/// How an anchor is fitted, before the first step, to what its images' statistics say about the RAW's brightness: a
/// line in closed form, then the network by Adam on what the line misses.
struct AnchorFitSettings {
    std::string from; ///< a model's name or path; empty: fit
    bool carry_on = false;
    int pairs = 24000;
    double ridge = 1e-3;
    int steps = 3000;
    int batch = 256;
    double rate = 2e-3;
    double weight_decay = 0.3;
    double dropout = 0.1;

    template<class Visitor> void describe(Visitor& v)
    {
        v.path("from", from, "model whose anchor is taken as it is, instead of a fit: a name or a path");
        v.flag("carry_on", carry_on, "a run that starts from a finished model fits its anchor's network further first");
        v.integer("pairs", pairs, 32, 10'000'000, "training pairs that the anchor is fitted to before the first step");
        v.number("ridge", ridge, 0, 1e3, "penalty on the squared weights of the line, per pair");
        v.integer("steps", steps, 1, 10'000'000, "optimiser steps of the anchor's network");
        v.integer("batch", batch, 1, 1'000'000, "pairs in each of them");
        v.number("rate", rate, 0, 1, "highest learning rate of the network, one cycle");
        v.number("weight_decay", weight_decay, 0, 10, "decoupled weight decay of the network");
        v.number("dropout", dropout, 0, 0.9, "share of the network's hidden values that are left out at each step");
    }
};

/// What a fit found. Deviations are root mean squares of the error of ln mean over pairs and channels; the last tenth
/// of the pairs is not fitted to, but for how sure the anchor is; all deviations are measured on it alone.
struct AnchorFit {
    torch::Tensor weight, bias;      ///< [3, 24], [3]: a linear regression of the RAW's log channel means [method 2]
    double line_deviation = 0;       ///< of the line
    double deviation = 0;            ///< of line and network
    double gain_match_deviation = 0; ///< where the reference's means are taken for the RAW's
};

/// The line, by ridge regression in closed form: `statistics` [n, 24], source's then reference's; `log_means` [n, 3].
/// n ≥ 2. Only `weight` and `bias` of the result are set.
AnchorFit fit_line(const torch::Tensor& statistics, const torch::Tensor& log_means, double ridge);

/// Gives `model` the anchor of another, of whatever kernel size. An error where either has none or theirs differ.
Status take_anchor(Unprocessor& model, Unprocessor& other);

/// Gives `model` an anchor between two others of its kind: each weight (1 − `share`) · first + `share` · second. Where
/// the second was carried on from the first, such a mix does better than either on what both were meant for. [Wortsman
/// et al. 2022, Robust fine-tuning of zero-shot models]
void mix_anchors(Unprocessor& model, Unprocessor& first, Unprocessor& second, double share);

/// The pairs that a fit of the model's anchor takes, none made so far; nothing where it has no anchor, or none that
/// could be carried on where the settings want that.
std::optional<AnchorPairs> pairs_for_anchor(Unprocessor& model, const AnchorFitSettings& settings);

/// Fits the model's anchor to `pairs`: those of `pairs_for_anchor`, complete. To carry on: the line stays, the network
/// learns from where it is. `progress` gets the part that is done, 0 … 1. `seed`: of the network's batches.
AnchorFit fit_anchor(Unprocessor& model, const AnchorPairs& pairs, const AnchorFitSettings& settings,
                     std::uint64_t seed, const std::function<void(double)>& progress = {});

/// Fits how sure the model's anchor is to the pairs that fit_anchor leaves out, once the anchor is what it will be.
/// Nothing where it has no network.
void fit_anchor_deviation(Unprocessor& model, const AnchorPairs& pairs, std::uint64_t seed);

} // namespace srisp::train
