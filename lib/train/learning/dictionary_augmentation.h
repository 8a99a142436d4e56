// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "train/network/unprocessor.h"

namespace srisp::train {

/// Photos made anew by the model's own forward pass, with white balance and colour matrix mixed at random from its
/// dictionaries: for a random `share` of the samples the photo in `source` is replaced by such a rendering of `truth`,
/// the rest stay. A reading of the dictionary augmentation of Conde et al. 2022. Sample i of a step is drawn from seed,
/// step and `first` + i alone. Models without these dictionaries or a forward pass give `source` back.
torch::Tensor augment_by_dictionaries(Unprocessor& model, const torch::Tensor& source, const torch::Tensor& truth,
                                      const torch::Tensor& reference, double share, std::uint64_t seed,
                                      std::int64_t step, int first);

} // namespace srisp::train
