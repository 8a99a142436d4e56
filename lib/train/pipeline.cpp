// SPDX-License-Identifier: Apache-2.0
#include "pipeline.h"

#include "pipeline_blocks.h"
#include "tone_map_network.h"

namespace srisp::train {

torch::Tensor reverse_pipeline(const torch::Tensor& source, const Choice& choice)
{
    torch::Tensor v = source;
    if (!choice.tone_reverse_weight.empty())
        v = apply_tone_map(v, choice.tone_reverse_weight, choice.tone_reverse_bias);
    v = power(v, choice.gamma);
    v = color_transform(v, inverse3x3(choice.color));
    v = inverse_gain(v, choice.white_balance);
    return inverse_gain(v, choice.gain.unsqueeze(1)).clamp(0, 1);
}

torch::Tensor forward_pipeline(const torch::Tensor& raw, const Choice& choice, bool white_stays_white)
{
    const torch::Tensor gain = choice.gain.view({ -1, 1, 1, 1 }), balance = choice.white_balance.view({ -1, 3, 1, 1 });
    torch::Tensor v = ((raw * gain).clamp(0, 1) * balance).clamp(0, 1);
    if (white_stays_white)
        v = torch::where(gain < 1, rebuilt_highlights(raw * balance, gain), v);
    v = color_transform(v, choice.color);
    v = power(v, choice.gamma.reciprocal());
    if (!choice.tone_forward_weight.empty())
        v = apply_tone_map(v, choice.tone_forward_weight, choice.tone_forward_bias);
    return v;
}

} // namespace srisp::train
