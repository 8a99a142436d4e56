// SPDX-License-Identifier: Apache-2.0
#include "train/network/anchor_network.h"

#include <algorithm>
#include <cmath>

#include <ATen/Parallel.h>

#include "features/image_features.h"
#include "features/match_features.h"

namespace srisp::train {

namespace {

/// The library takes float32 planes in the CPU's memory.
torch::Tensor as_planes(const torch::Tensor& images)
{
    return images.detach().to(torch::kCPU, torch::kFloat32).contiguous();
}

PlanarImage image_of(const torch::Tensor& images, std::int64_t i)
{
    const std::int64_t height = images.size(2), width = images.size(3), pixels = height * width;
    return { { images.data_ptr<float>() + i * 3 * pixels, pixels }, static_cast<int>(height), static_cast<int>(width) };
}

/// `numbers_of(i)`, an array of `count`, for each of n images.
template<class Numbers> torch::Tensor numbers_of_each(std::int64_t n, int count, const Numbers& numbers_of)
{
    torch::Tensor result = torch::empty({ n, count });
    float* const numbers = result.data_ptr<float>();
    at::parallel_for(0, n, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const auto some = numbers_of(i);
            std::copy(some.begin(), some.end(), numbers + i * count);
        }
    });
    return result;
}

constexpr std::int64_t kHidden = 256, kDeviationHidden = 32;
constexpr double kFirstDeviation = 0.4; // of ln brightness, about gain match's
constexpr double kFirstOutput = 0.1;    // part of the usual scale: the line comes first

} // namespace

torch::Tensor image_statistics(const torch::Tensor& linear)
{
    const torch::Tensor images = as_planes(linear);
    return numbers_of_each(images.size(0), 12,
                           [&](std::int64_t i) {
                               const PlanarImage image = image_of(images, i);
                               return statistics(image.planes, static_cast<std::size_t>(image.height) * image.width);
                           })
        .to(linear.device());
}

torch::Tensor image_quantiles(const torch::Tensor& linear)
{
    const torch::Tensor images = as_planes(linear);
    return numbers_of_each(images.size(0), kQuantileFeatures,
                           [&](std::int64_t i) { return quantile_features(reduced(image_of(images, i))); })
        .to(linear.device());
}

torch::Tensor image_match(const torch::Tensor& linear_source, const torch::Tensor& reference)
{
    const torch::Tensor sources = as_planes(linear_source), references = as_planes(reference);
    return numbers_of_each(sources.size(0), kMatchFeatures,
                           [&](std::int64_t i) {
                               return match_features(reduced(image_of(sources, i)), reduced(image_of(references, i)));
                           })
        .to(linear_source.device());
}

torch::Tensor linear_source(const torch::Tensor& display)
{
    return display.detach().clamp_min(1e-8).pow(2.2);
}

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

torch::Tensor AnchorNetwork::hidden(const torch::Tensor& inputs,
                                    const std::function<torch::Tensor(const torch::Tensor&)>& after_hidden) const
{
    torch::Tensor x = inputs;
    for (std::size_t l = 0; l + 1 < m_layers.size(); ++l) {
        x = torch::relu(m_layers[l]->affine(x));
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

AnchorDeviation::AnchorDeviation(InitialWeights& initial)
    : m_first(register_module("0", std::make_shared<Layer>(initial.he({ kDeviationHidden, kHidden })))),
      m_second(register_module("1", std::make_shared<Layer>(initial.affine({ 1, kDeviationHidden }) * kFirstOutput)))
{
    scale(kFirstDeviation);
}

torch::Tensor AnchorDeviation::forward(const torch::Tensor& hidden) const
{
    return m_second->affine(torch::relu(m_first->affine(hidden))).squeeze(1);
}

void AnchorDeviation::scale(double factor)
{
    const torch::NoGradGuard no_gradient;
    m_second->bias.add_(std::log(factor));
}

} // namespace srisp::train
