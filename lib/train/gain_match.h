// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "unprocessor.h"

namespace srisp::train {

/// The bar that a method must clear: x^2.2 times one gain per channel that gives it the reference's channel means
/// [method 4]. Learns nothing. Its choice: `gamma` 2.2 and, as `white_balance`, the gains of the forward pass.
class GainMatch : public Unprocessor {
public:
    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          Choice* choice = nullptr) override;
    torch::Tensor apply_reverse(const torch::Tensor& image, const Choice& choice) override;
    torch::Tensor process(const torch::Tensor& raw, const Choice& choice) override;
    std::vector<torch::Tensor> dictionary_parameters() override { return {}; }
};

} // namespace srisp::train
