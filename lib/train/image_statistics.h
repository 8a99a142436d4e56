// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

/// The twelve brightness numbers of linear images [N, 3, H, W], as [N, 12] (srisp::statistics, the same code as the
/// library's). No gradient flows through them: the images are data.
torch::Tensor image_statistics(const torch::Tensor& linear);

/// What the anchor's network sees of linear images besides, as [N, 71] (srisp::quantile_features); likewise.
torch::Tensor image_quantiles(const torch::Tensor& linear);

/// And of the two together, as [N, 51] (srisp::match_features); likewise.
torch::Tensor image_match(const torch::Tensor& linear_source, const torch::Tensor& reference);

/// A display-encoded image made linear for these: max(v, 1e-8)^2.2.
torch::Tensor linear_source(const torch::Tensor& display);

} // namespace srisp::train
