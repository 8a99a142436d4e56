// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "initial_weights.h"

namespace srisp::train {

/// A layer with weight and bias, registered under these names; bias starts at 0.
struct Layer : torch::nn::Module {
    /// One bias per output, or of another shape; an undefined weight leaves the bias alone.
    explicit Layer(const torch::Tensor& initial_weight);
    Layer(const torch::Tensor& initial_weight, torch::IntArrayRef bias_shape);
    /// weight · x + bias, x: [N, inputs].
    torch::Tensor affine(const torch::Tensor& x) const { return torch::addmm(bias, x, weight.t()); }
    torch::Tensor weight, bias;
};

/// 3×3 convolutions of stride 2, zeros around, ReLU on all but the last, then the mean: [N, C, H, W] → [N, features].
/// (h_x, h_r, h_i of method 2.)
class FeatureEncoder : public torch::nn::Module {
public:
    /// `channels`: of the input and after each layer.
    FeatureEncoder(const std::vector<std::int64_t>& channels, InitialWeights& initial);
    torch::Tensor forward(torch::Tensor x) const;

private:
    std::vector<std::shared_ptr<Layer>> m_layers;
};

} // namespace srisp::train
