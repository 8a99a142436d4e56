// SPDX-License-Identifier: Apache-2.0
#include "train/network/dictionaries.h"

#include <cmath>

#include "train/network/pipeline.h"
#include "train/tensors/color.h"

namespace srisp::train {

namespace {

// Corrections around 1 [method 6].
constexpr double kAnchoredGain = 0.9, kWhiteBalance = 0.4;
// Without an anchor gains are absolute: exposures in the data run from about 1/20 to 3/2.
constexpr double kLowestGain = 0.7, kHighestGain = 20;
// … and the middle between daylight (about 2.5, 1.3) and tungsten (about 1.1, 2.8).
constexpr double kMiddleRed = 1.7, kMiddleBlue = 1.9;

std::vector<torch::Tensor> color_matrices(const ModelSettings& settings)
{
    std::vector<torch::Tensor> matrices;
    for (const std::array<float, 9>& given : settings.initial_color)
        matrices.push_back(torch::tensor(std::vector<float>(given.begin(), given.end())).view({ 3, 3 }));
    if (!matrices.empty())
        return matrices;
    matrices = inverse3x3(dnd_rgb_to_camera()).unbind();
    // A camera whose colours are nearly sRGB's, so that the hull reaches towards the identity.
    matrices.push_back(1.3 * torch::eye(3) - 0.1);
    return matrices;
}

/// As many as there are atoms; those that are missing lie between two of the others, so that no two atoms are equal.
torch::Tensor color_atoms(const ModelSettings& settings)
{
    std::vector<torch::Tensor> matrices = color_matrices(settings);
    for (std::size_t i = 0; matrices.size() < static_cast<std::size_t>(settings.dictionary_size); ++i)
        matrices.push_back(0.6 * matrices[i] + 0.4 * matrices[i + 1 < matrices.size() ? i + 1 : 0]);
    matrices.resize(settings.dictionary_size);
    return torch::stack(matrices);
}

/// 0, K − 1, 1, K − 2, …: with it two dictionaries become one whose atoms do not lie on a line.
std::vector<std::int64_t> alternating(int atoms)
{
    std::vector<std::int64_t> order;
    for (int k = 0; k < atoms; ++k)
        order.push_back(k % 2 == 0 ? k / 2 : atoms - 1 - k / 2);
    return order;
}

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

InitialAtoms initial_atoms(const ModelSettings& settings)
{
    const int atoms = settings.dictionary_size;
    // A dictionary of one atom starts in the middle.
    const torch::Tensor spread = atoms > 1 ? torch::linspace(-1, 1, atoms) : torch::zeros({ 1 });
    InitialAtoms initial;
    initial.gamma = 2.4 + 0.8 * spread;
    initial.color = color_atoms(settings);
    initial.white_balance = torch::exp(kWhiteBalance * torch::stack({ -spread, spread }, 1));
    initial.gain = torch::exp(kAnchoredGain * spread);
    if (!settings.anchor) {
        initial.white_balance = initial.white_balance * torch::tensor({ kMiddleRed, kMiddleBlue });
        const double low = std::log(kLowestGain), high = std::log(kHighestGain);
        initial.gain = torch::exp((low + high) / 2 + (high - low) / 2 * spread);
    }
    if (settings.gain == "merged") {
        const torch::Tensor color = initial.white_balance.index_select(0, torch::tensor(alternating(atoms)));
        initial.white_balance = torch::stack({ color.select(1, 0), torch::ones({ atoms }), color.select(1, 1) }, 1) *
                                initial.gain.unsqueeze(1);
        initial.gain = torch::Tensor();
    }
    return initial;
}

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
