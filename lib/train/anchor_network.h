// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "feature_encoder.h"

namespace srisp::train {

/// What the anchor's network sees of a source (made linear) and a reference, [N, 110]: their twelve
/// statistics each, [N, 24] (the anchor's line sees these alone), then their 43 quantile features each.
torch::Tensor anchor_inputs(const torch::Tensor& statistics, const torch::Tensor& linear_source,
                            const torch::Tensor& reference);

constexpr int kAnchorStatistics = 24, kAnchorInputs = 110;

/// What a line misses of the RAW's log channel means: three affine layers with ReLU between, [N, 110] → [N, 3].
class AnchorNetwork : public torch::nn::Module {
public:
    explicit AnchorNetwork(InitialWeights& initial);
    torch::Tensor forward(const torch::Tensor& inputs) const;

    /// Makes a network that learnt from (inputs − mean) / deviation one that takes the inputs as they are.
    void take_plain_inputs(const torch::Tensor& mean, const torch::Tensor& deviation);

private:
    std::vector<std::shared_ptr<Layer>> m_layers;
};

} // namespace srisp::train
