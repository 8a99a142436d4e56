// SPDX-License-Identifier: Apache-2.0
#include "dictionaries.h"

#include "initial_atoms.h"
#include "pipeline_blocks.h"

namespace srisp::train {

namespace {

constexpr double kSmallestGain = 1e-2, kSmallestGamma = 0.3, kSmallestDeterminant = 0.05;

/// The kernels of all atoms of one layer share half of their variance: mixed with about equal weights, kernels that
/// share nothing would cancel, and signals vanish within the four layers. They start with their middle alone, each
/// pixel by itself: what the neighbours are good for has to be learnt, instead of random weights to be unlearnt.
torch::Tensor kernels(int atoms, std::int64_t outputs, std::int64_t inputs, int size, double scale,
                      InitialWeights& initial)
{
    const std::int64_t shape[] = { outputs, inputs, 1, 1 };
    const torch::Tensor common = initial.he(shape);
    std::vector<torch::Tensor> all;
    for (int k = 0; k < atoms; ++k)
        all.push_back((common + initial.he(shape)) * (scale / std::sqrt(2.0)));
    const int border = size / 2;
    return torch::constant_pad_nd(torch::stack(all), { border, border, border, border });
}

} // namespace

Dictionaries::Dictionaries(const ModelSettings& settings, InitialWeights& initial)
{
    const InitialAtoms atoms = initial_atoms(settings);
    gamma = register_parameter("gamma", atoms.gamma);
    color = register_parameter("color", atoms.color);
    white_balance = register_parameter("white_balance", atoms.white_balance);
    if (atoms.gain.defined())
        gain = register_parameter("gain", atoms.gain);
    add_tone_maps(settings.dictionary_size, settings.kernel_size == "1" ? 1 : 3, initial);
}

void Dictionaries::add_tone_maps(int atoms, int kernel_size, InitialWeights& initial)
{
    constexpr std::int64_t channels[] = { 3, 32, 32, 32, 3 };
    // The last layer starts near 0, so that the tone map starts as the identity.
    constexpr double scales[] = { 1, 1, 1, 1e-2 };
    for (auto [name, layers] : { std::pair("tone_reverse", &tone_reverse), std::pair("tone_forward", &tone_forward) }) {
        const auto list = register_module(name, std::make_shared<torch::nn::Module>());
        for (int l = 0; l < 4; ++l) {
            const auto layer =
                std::make_shared<Layer>(kernels(atoms, channels[l + 1], channels[l], kernel_size, scales[l], initial),
                                        std::vector<std::int64_t>{ atoms, channels[l + 1] });
            layers->push_back(list->register_module(std::to_string(l), layer));
        }
    }
}

torch::Tensor Dictionaries::normalized_color() const
{
    return row_normalized(color);
}

torch::Tensor Dictionaries::channel_gains() const
{
    if (!gain.defined())
        return white_balance;
    const torch::Tensor red = white_balance.select(1, 0), blue = white_balance.select(1, 1);
    return torch::stack({ red, torch::ones_like(red), blue }, 1);
}

std::vector<torch::Tensor> Dictionaries::scalars() const
{
    std::vector<torch::Tensor> all{ gamma, color, white_balance };
    if (gain.defined())
        all.push_back(gain);
    return all;
}

void Dictionaries::constrain()
{
    const torch::NoGradGuard no_gradient;
    gamma.clamp_(kSmallestGamma);
    white_balance.clamp_(kSmallestGain);
    if (gain.defined())
        gain.clamp_(kSmallestGain);
    torch::Tensor matrices = row_normalized(color);
    const torch::Tensor singular = (torch::det(matrices) < kSmallestDeterminant).view({ -1, 1, 1 });
    // Towards the identity, whose rows sum to 1 too.
    matrices = torch::where(singular, 0.9 * matrices + 0.1 * torch::eye(3, matrices.options()), matrices);
    color.copy_(matrices);
}

} // namespace srisp::train
