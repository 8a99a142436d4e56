// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples.h"

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

} // namespace srisp::train
