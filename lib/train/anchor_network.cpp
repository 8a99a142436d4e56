// SPDX-License-Identifier: Apache-2.0
#include "anchor_network.h"

#include "image_statistics.h"

namespace srisp::train {

namespace {

constexpr std::int64_t kHidden = 256;
constexpr double kFirstOutput = 0.1; // part of the usual scale: the line comes first

} // namespace

torch::Tensor anchor_inputs(const torch::Tensor& statistics, const torch::Tensor& linear_source,
                            const torch::Tensor& reference)
{
    return torch::cat({ statistics, image_quantiles(linear_source), image_quantiles(reference),
                        image_match(linear_source, reference) },
                      1);
}

AnchorNetwork::AnchorNetwork(InitialWeights& initial)
{
    const auto add = [this](const torch::Tensor& weight) {
        m_layers.push_back(register_module(std::to_string(m_layers.size()), std::make_shared<Layer>(weight)));
    };
    add(initial.he({ kHidden, kAnchorInputs }));
    add(initial.he({ kHidden, kHidden }));
    add(initial.he({ kHidden, kHidden }));
    add(initial.affine({ 3, kHidden }) * kFirstOutput);
}

torch::Tensor AnchorNetwork::forward(const torch::Tensor& inputs,
                                     const std::function<torch::Tensor(const torch::Tensor&)>& after_hidden) const
{
    torch::Tensor x = inputs;
    for (const std::shared_ptr<Layer>& layer : m_layers) {
        x = layer->affine(x);
        if (layer == m_layers.back())
            break;
        x = torch::relu(x);
        if (after_hidden)
            x = after_hidden(x);
    }
    return x;
}

void AnchorNetwork::take_plain_inputs(const torch::Tensor& mean, const torch::Tensor& deviation)
{
    const torch::NoGradGuard no_gradient;
    Layer& first = *m_layers.front();
    first.weight.div_(deviation);
    first.bias.sub_(torch::mv(first.weight, mean));
}

void AnchorNetwork::take_scaled_inputs(const torch::Tensor& mean, const torch::Tensor& deviation)
{
    const torch::NoGradGuard no_gradient;
    Layer& first = *m_layers.front();
    first.bias.add_(torch::mv(first.weight, mean));
    first.weight.mul_(deviation);
}

} // namespace srisp::train
