// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "features/image_features.h"
#include "features/match_features.h"
#include "train/network/layers.h"
#include "train/tensors/torch_api.h"

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

/// What the anchor's network sees of a source (made linear) and a reference, [N, 217]: their twelve
/// statistics each, [N, 24] (the anchor's line sees these alone), then their 71 quantile features each, then 51 numbers
/// about how the two match.
torch::Tensor anchor_inputs(const torch::Tensor& statistics, const torch::Tensor& linear_source,
                            const torch::Tensor& reference);

constexpr int kAnchorStatistics = 24;
constexpr int kAnchorInputs = kAnchorStatistics + 2 * kQuantileFeatures + kMatchFeatures;

/// What a line misses of the RAW's log channel means: four affine layers with ReLU between, [N, 217] → [N, 3].
class AnchorNetwork : public torch::nn::Module {
public:
    explicit AnchorNetwork(InitialWeights& initial);
    /// `after_hidden` is done to the values of each hidden layer (dropout, while it learns).
    torch::Tensor forward(const torch::Tensor& inputs,
                          const std::function<torch::Tensor(const torch::Tensor&)>& after_hidden = {}) const
    {
        return m_layers.back()->affine(hidden(inputs, after_hidden));
    }
    /// The values of the last hidden layer, [N, 256].
    torch::Tensor hidden(const torch::Tensor& inputs,
                         const std::function<torch::Tensor(const torch::Tensor&)>& after_hidden = {}) const;

    /// Makes a network that learnt from (inputs − mean) / deviation one that takes the inputs as they are.
    void take_plain_inputs(const torch::Tensor& mean, const torch::Tensor& deviation);
    /// The other way.
    void take_scaled_inputs(const torch::Tensor& mean, const torch::Tensor& deviation);

private:
    std::vector<std::shared_ptr<Layer>> m_layers;
};

/// How sure the anchor is: ln of the standard deviation of the error of brightness (the mean of R, G, B's log channel
/// means), of the values of the network's last hidden layer: two affine layers with ReLU between, [N, 256] → [N].
class AnchorDeviation : public torch::nn::Module {
public:
    explicit AnchorDeviation(InitialWeights& initial);
    torch::Tensor forward(const torch::Tensor& hidden) const;
    /// Makes all deviations larger by this factor.
    void scale(double factor);

private:
    std::shared_ptr<Layer> m_first, m_second;
};

} // namespace srisp::train
