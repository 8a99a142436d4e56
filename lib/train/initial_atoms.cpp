// SPDX-License-Identifier: Apache-2.0
#include "initial_atoms.h"

#include <cmath>

#include "dnd_cameras.h"
#include "pipeline_blocks.h"

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

} // namespace srisp::train
