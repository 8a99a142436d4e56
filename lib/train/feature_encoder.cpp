// SPDX-License-Identifier: Apache-2.0
#include "feature_encoder.h"

namespace srisp::train {

Layer::Layer(const torch::Tensor& initial_weight) : Layer(initial_weight, { initial_weight.size(0) }) {}

Layer::Layer(const torch::Tensor& initial_weight, torch::IntArrayRef bias_shape)
{
    if (initial_weight.defined())
        weight = register_parameter("weight", initial_weight);
    bias = register_parameter("bias", torch::zeros(bias_shape));
}

FeatureEncoder::FeatureEncoder(const std::vector<std::int64_t>& channels, InitialWeights& initial)
{
    for (std::size_t l = 0; l + 1 < channels.size(); ++l)
        m_layers.push_back(register_module(
            std::to_string(l), std::make_shared<Layer>(initial.he({ channels[l + 1], channels[l], 3, 3 }))));
}

torch::Tensor FeatureEncoder::forward(torch::Tensor x) const
{
    for (const std::shared_ptr<Layer>& layer : m_layers) {
        x = torch::conv2d(x, layer->weight, layer->bias, 2, 1);
        if (layer != m_layers.back())
            x = torch::relu(x);
    }
    return x.mean({ 2, 3 });
}

} // namespace srisp::train
