// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "torch_api.h"

namespace srisp::train {

/// What one optimiser step learns from; images as in unprocessor.h.
struct Batch {
    torch::Tensor source, truth, reference;            ///< pseudo pairs PP_rand: [N, 3, S, S]
    torch::Tensor unpaired_source, unpaired_reference; ///< for PP_MT: [M, 3, S, S]; photos as they are, and RAW images
};

/// Makes batches from a training pack. A batch depends on the settings, the seed and the step alone: not on threads,
/// not on the steps before, and sample i of a batch not on the batch's size; so runs resume exactly and ranks share one
/// batch.
class Samples {
public:
    virtual ~Samples() = default;

    /// Samples `first` to `first + pairs` of the pseudo pairs of a step, and likewise of the unpaired ones.
    virtual Batch batch(std::int64_t step, int first_pair, int pairs, int first_unpaired, int unpaired) = 0;
};

} // namespace srisp::train
