// SPDX-License-Identifier: Apache-2.0
#include "train/baselines/baselines.h"

#include "rendering/upi.h"
#include "train/network/pipeline.h"
#include "train/tensors/color.h"

namespace srisp::train {

namespace {

constexpr double kGamma = 2.2, kSmallestMean = 1e-6;

torch::Tensor mean_color(const torch::Tensor& image)
{
    return image.mean({ 2, 3 }).clamp_min(kSmallestMean);
}

constexpr int kLevels = 4, kAlignment = 1 << (kLevels - 1);
constexpr double kFirstOutput = -2; // sigmoid⁻¹ of about 0.12, a usual brightness of RAW images

torch::Tensor through(const std::vector<std::shared_ptr<Layer>>& layers, torch::Tensor x)
{
    for (const std::shared_ptr<Layer>& layer : layers)
        x = torch::relu(torch::conv2d(x, layer->weight, layer->bias, 1, 1));
    return x;
}

} // namespace

torch::Tensor GainMatch::reverse(const torch::Tensor& source, const torch::Tensor& reference, ChosenParameters* choice)
{
    ChosenParameters own;
    own.gamma = torch::full({ source.size(0) }, kGamma, source.options());
    own.white_balance = mean_color(power(source, own.gamma)) / mean_color(reference);
    if (choice)
        *choice = own;
    return apply_reverse(source, own);
}

torch::Tensor GainMatch::apply_reverse(const torch::Tensor& image, const ChosenParameters& choice)
{
    return (power(image, choice.gamma) / choice.white_balance.view({ -1, 3, 1, 1 })).clamp(0, 1);
}

torch::Tensor GainMatch::process(const torch::Tensor& raw, const ChosenParameters& choice)
{
    return power((raw * choice.white_balance.view({ -1, 3, 1, 1 })).clamp(0, 1), choice.gamma.reciprocal());
}

ChosenParameters Upi::next_choice(std::int64_t images)
{
    std::vector<torch::Tensor> rgb_to_camera, gains;
    for (std::int64_t i = 0; i < images; ++i) {
        const UpiParameters drawn = draw_upi(Random(m_seed, m_images_seen++));
        rgb_to_camera.push_back(torch::tensor(at::ArrayRef<float>(drawn.to_camera)).view({ 3, 3 }));
        gains.push_back(torch::tensor(at::ArrayRef<float>(drawn.gains)));
    }
    ChosenParameters choice;
    choice.gamma = torch::full({ images }, 2.2);
    choice.color = inverse3x3(torch::stack(rgb_to_camera));
    choice.white_balance = torch::stack(gains);
    choice.gain = torch::ones({ images });
    return choice;
}

torch::Tensor Upi::reverse(const torch::Tensor& source, const torch::Tensor&, ChosenParameters* choice)
{
    ChosenParameters own = next_choice(source.size(0));
    for (torch::Tensor* value : { &own.gamma, &own.color, &own.white_balance, &own.gain })
        *value = value->to(source.device());
    if (choice)
        *choice = own;
    return apply_reverse(source, own);
}

torch::Tensor Upi::apply_reverse(const torch::Tensor& image, const ChosenParameters& choice)
{
    const torch::Tensor linear = power(inverse_smoothstep(image), choice.gamma);
    const torch::Tensor camera = torch::bmm(inverse3x3(choice.color), linear.flatten(2)).view_as(image);
    return inverse_gain(camera, choice.white_balance).clamp(0, 1);
}

torch::Tensor Upi::process(const torch::Tensor& raw, const ChosenParameters& choice)
{
    torch::Tensor v = (raw * choice.white_balance.view({ -1, 3, 1, 1 })).clamp(0, 1);
    v = power(color_transform(v, choice.color), choice.gamma.reciprocal());
    return 3 * v.square() - 2 * v.pow(3);
}

UNet::UNet(int channels, std::uint64_t seed)
{
    InitialWeights initial(seed);
    for (int level = 0; level < kLevels; ++level)
        m_down.push_back(
            add_pair("down_" + std::to_string(level), level ? channels << (level - 1) : 3, channels << level, initial));
    for (int level = kLevels - 2; level >= 0; --level)
        m_up.push_back(add_pair("up_" + std::to_string(level), (channels << level) * 3, channels << level, initial));
    m_last = register_module("last", std::make_shared<Layer>(initial.affine({ 3, channels, 1, 1 })));
    const torch::NoGradGuard no_gradient;
    m_last->bias.fill_(kFirstOutput);
}

UNet::Layers UNet::add_pair(const std::string& name, std::int64_t inputs, std::int64_t outputs, InitialWeights& initial)
{
    const auto list = register_module(name, std::make_shared<torch::nn::Module>());
    return { list->register_module("0", std::make_shared<Layer>(initial.he({ outputs, inputs, 3, 3 }))),
             list->register_module("1", std::make_shared<Layer>(initial.he({ outputs, outputs, 3, 3 }))) };
}

torch::Tensor UNet::reverse(const torch::Tensor& source, const torch::Tensor&, ChosenParameters* choice)
{
    if (choice)
        *choice = {};
    return apply_reverse(source, {});
}

torch::Tensor UNet::apply_reverse(const torch::Tensor& image, const ChosenParameters&)
{
    const std::int64_t height = image.size(2), width = image.size(3);
    const auto missing = [](std::int64_t size) { return (kAlignment - size % kAlignment) % kAlignment; };
    torch::Tensor x = torch::replication_pad2d(image, { 0, missing(width), 0, missing(height) });
    std::vector<torch::Tensor> levels;
    for (const Layers& layers : m_down) {
        x = through(layers, levels.empty() ? x : torch::max_pool2d(x, 2));
        levels.push_back(x);
    }
    for (std::size_t i = 0; i < m_up.size(); ++i) {
        const torch::Tensor& beside = levels[levels.size() - 2 - i];
        x = torch::upsample_nearest2d(x, { beside.size(2), beside.size(3) });
        x = through(m_up[i], torch::cat({ beside, x }, 1));
    }
    x = torch::sigmoid(torch::conv2d(x, m_last->weight, m_last->bias));
    return x.slice(2, 0, height).slice(3, 0, width);
}

torch::Tensor UNet::process(const torch::Tensor&, const ChosenParameters&)
{
    return {};
}

} // namespace srisp::train
