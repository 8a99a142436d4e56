// SPDX-License-Identifier: Apache-2.0
#include "gain_match.h"

#include "pipeline_blocks.h"

namespace srisp::train {

namespace {

constexpr double kGamma = 2.2, kSmallestMean = 1e-6;

torch::Tensor mean_color(const torch::Tensor& image)
{
    return image.mean({ 2, 3 }).clamp_min(kSmallestMean);
}

} // namespace

torch::Tensor GainMatch::reverse(const torch::Tensor& source, const torch::Tensor& reference, Choice* choice)
{
    Choice own;
    own.gamma = torch::full({ source.size(0) }, kGamma, source.options());
    own.white_balance = mean_color(power(source, own.gamma)) / mean_color(reference);
    if (choice)
        *choice = own;
    return apply_reverse(source, own);
}

torch::Tensor GainMatch::apply_reverse(const torch::Tensor& image, const Choice& choice)
{
    return (power(image, choice.gamma) / choice.white_balance.view({ -1, 3, 1, 1 })).clamp(0, 1);
}

torch::Tensor GainMatch::process(const torch::Tensor& raw, const Choice& choice)
{
    return power((raw * choice.white_balance.view({ -1, 3, 1, 1 })).clamp(0, 1), choice.gamma.reciprocal());
}

} // namespace srisp::train
