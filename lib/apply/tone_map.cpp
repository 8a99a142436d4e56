// SPDX-License-Identifier: Apache-2.0
#include "apply/tone_map.h"

#include "apply/pointwise_tone_map.h"
#include "apply/rolling_tone_map.h"
#include "apply/winograd_tone_map.h"
#include "kernels/bf16_convolution.h"

namespace srisp {

ConvolutionWeights mix_layer(const ConvolutionWeights& dictionary, const std::vector<float>& weights)
{
    ConvolutionWeights mixed{ dictionary.inputs, dictionary.outputs, dictionary.taps, {}, {} };
    const auto mix = [&](const std::vector<float>& atoms, std::vector<float>& out) {
        const std::size_t size = atoms.size() / weights.size();
        out.assign(size, 0.0f);
        for (std::size_t k = 0; k < weights.size(); ++k)
            for (std::size_t i = 0; i < size; ++i)
                out[i] += weights[k] * atoms[k * size + i];
    };
    mix(dictionary.weight, mixed.weight);
    mix(dictionary.bias, mixed.bias);
    return mixed;
}

std::array<ConvolutionWeights, kToneLayers> mix_layers(const ToneDictionary& dictionary,
                                                       const std::array<std::vector<float>, kToneLayers>& weights)
{
    std::array<ConvolutionWeights, kToneLayers> layers;
    for (int l = 0; l < kToneLayers; ++l)
        layers[l] = mix_layer(dictionary[l], weights[l]);
    return layers;
}

ToneMethod tone_method(Precision precision)
{
    if (precision == Precision::float32)
        return ToneMethod::plain;
    return has_bf16() ? ToneMethod::bf16 : ToneMethod::winograd;
}

std::unique_ptr<const ToneMap> mix_tone_map(const ToneDictionary& dictionary,
                                            const std::array<std::vector<float>, kToneLayers>& weights,
                                            ToneMethod method)
{
    const std::array<ConvolutionWeights, kToneLayers> layers = mix_layers(dictionary, weights);
    if (layers[0].taps == 1)
        return std::make_unique<PointwiseToneMap>(layers);
    switch (method) {
    case ToneMethod::winograd:
        return std::make_unique<WinogradToneMap>(layers);
    case ToneMethod::bf16:
        return std::make_unique<RollingToneMap>(bf16_tone_map(layers));
    case ToneMethod::plain:
        break;
    }
    return std::make_unique<RollingToneMap>(float_tone_map(layers));
}

} // namespace srisp
