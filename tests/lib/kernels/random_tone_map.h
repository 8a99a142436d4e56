// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "kernels/pixel_tone_map.h"
#include "random_model.h"

/// The layers of a made-up pointwise tone map that moves values by some tenths.
inline std::array<srisp::ConvolutionWeights, srisp::kToneLayers> random_tone_layers()
{
    Random random(11);
    std::array<srisp::ConvolutionWeights, srisp::kToneLayers> layers;
    for (int l = 0; l < srisp::kToneLayers; ++l) {
        srisp::ConvolutionWeights& layer = layers[l];
        layer = { l == 0 ? 3 : srisp::kToneChannels, l == 3 ? 3 : srisp::kToneChannels, 1, {}, {} };
        for (int i = 0; i < layer.inputs * layer.outputs; ++i)
            layer.weight.push_back(random.uniform(-1, 1) * (l == 0 ? 1.0f : 0.25f));
        for (int o = 0; o < layer.outputs; ++o)
            layer.bias.push_back(random.uniform(-0.2f, 0.2f));
    }
    return layers;
}

/// v + φ(v) by the kernels in plain C++.
inline void tone_map_in_plain_cpp(const srisp::PixelToneMap& layers, srisp::Planes in, srisp::Planes out,
                                  std::size_t count)
{
    const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(count);
    std::vector<float> a(srisp::kToneChannels * count), b(a.size());
    for (int c = 0; c < 3; ++c)
        std::copy_n(in.plane(c), count, &a[c * count]);
    for (int l = 0; l < srisp::kToneLayers; ++l) {
        convolve_row_scalar(layers[l], { { a.data() }, stride, b.data(), stride, static_cast<int>(count), l < 3 });
        std::swap(a, b);
    }
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < count; ++x)
            out.plane(c)[x] = in.plane(c)[x] + a[c * count + x];
}
