// SPDX-License-Identifier: Apache-2.0
#include "train/network/layers.h"

namespace srisp::train {

namespace {

constexpr int kBlockFeatures = 32, kImageFeatures = 128;

/// Registers layers as `name`, or as `name`.0, `name`.1, … where there are several.
std::vector<std::shared_ptr<Layer>> add_layers(torch::nn::Module& parent, const std::string& name, int count,
                                               const std::function<std::shared_ptr<Layer>()>& make)
{
    if (count == 1)
        return { parent.register_module(name, make()) };
    const auto list = parent.register_module(name, std::make_shared<torch::nn::Module>());
    std::vector<std::shared_ptr<Layer>> layers;
    for (int i = 0; i < count; ++i)
        layers.push_back(list->register_module(std::to_string(i), make()));
    return layers;
}

} // namespace

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

BlockSelector::BlockSelector(Selection selection, int input_channels, int dictionaries, int atoms,
                             InitialWeights& initial)
    : m_selection(selection)
{
    if (selection == Selection::fixed) {
        m_head = add_layers(*this, "head", dictionaries,
                            [&] { return std::make_shared<Layer>(torch::Tensor(), torch::IntArrayRef{ atoms }); });
        return;
    }
    m_encoder = register_module(
        "encoder",
        std::make_shared<FeatureEncoder>(
            std::vector<std::int64_t>{ input_channels, kBlockFeatures, kBlockFeatures, kBlockFeatures, kBlockFeatures },
            initial));
    if (selection == Selection::dynamic)
        m_project = add_layers(*this, "project", dictionaries, [&] {
            return std::make_shared<Layer>(initial.affine({ kBlockFeatures, kImageFeatures }));
        });
    m_head = add_layers(*this, "head", dictionaries, [&] {
        return std::make_shared<Layer>(initial.affine({ atoms, kBlockFeatures }));
    });
}

std::vector<torch::Tensor> BlockSelector::weights(std::int64_t images, const torch::Tensor& fused,
                                                  const std::function<torch::Tensor()>& input) const
{
    const torch::Tensor features = m_encoder ? m_encoder->forward(input()) : torch::Tensor();
    std::vector<torch::Tensor> result;
    for (std::size_t d = 0; d < m_head.size(); ++d) {
        torch::Tensor logits;
        if (m_selection == Selection::fixed)
            logits = m_head[d]->bias.expand({ images, m_head[d]->bias.size(0) });
        else if (m_selection == Selection::intermediate)
            logits = m_head[d]->affine(features);
        else
            logits = m_head[d]->affine(m_project[d]->affine(fused) + features);
        result.push_back(torch::softmax(logits, 1));
    }
    return result;
}

std::vector<torch::Tensor> BlockSelector::fixed_parameters() const
{
    std::vector<torch::Tensor> result;
    if (m_selection == Selection::fixed)
        for (const std::shared_ptr<Layer>& head : m_head)
            result.push_back(head->bias);
    return result;
}

} // namespace srisp::train
