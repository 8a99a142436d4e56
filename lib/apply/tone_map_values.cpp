// SPDX-License-Identifier: Apache-2.0
#include <srisp/apply.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <srisp/model.h>

#include "apply/tone_map.h"
#include "base/guarded.h"
#include "base/parallel.h"

namespace srisp {

namespace {

constexpr int kBlock = 128; // pixels whose activations (two layers of 32 channels: 32 KB) stay in L1
using Layers = std::array<ConvolutionWeights, kToneLayers>;
using Activations = std::vector<float>; // channels × kBlock

/// Compilers vectorise the loop over pixels.
void run_layer(const ConvolutionWeights& layer, const Activations& in, Activations& out, bool relu)
{
    for (int o = 0; o < layer.outputs; ++o) {
        float* row = &out[std::size_t(o) * kBlock];
        std::fill_n(row, kBlock, layer.bias[o]);
        for (int i = 0; i < layer.inputs; ++i) {
            const float weight = layer.weight[std::size_t(o) * layer.inputs + i];
            const float* values = &in[std::size_t(i) * kBlock];
            for (int x = 0; x < kBlock; ++x)
                row[x] += weight * values[x];
        }
        if (relu)
            for (int x = 0; x < kBlock; ++x)
                row[x] = std::max(row[x], 0.0f);
    }
}

void run_block(const Layers& layers, const float* rgb, int count, float* out)
{
    std::size_t channels = 3;
    for (const ConvolutionWeights& layer : layers)
        channels = std::max<std::size_t>(channels, layer.outputs);
    Activations a(channels * kBlock), b(channels * kBlock);
    for (int x = 0; x < count; ++x)
        for (int c = 0; c < 3; ++c)
            a[std::size_t(c) * kBlock + x] = rgb[3 * x + c];
    for (int l = 0; l < kToneLayers; ++l) {
        run_layer(layers[l], a, b, l + 1 < kToneLayers);
        std::swap(a, b);
    }
    for (int x = 0; x < count; ++x)
        for (int c = 0; c < 3; ++c)
            out[3 * x + c] = rgb[3 * x + c] + a[std::size_t(c) * kBlock + x];
}

} // namespace

Status tone_map_values(const Model& model, const Parameters& parameters, Direction direction, const float* rgb,
                       std::int64_t count, float* out)
{
    if (model.kernel_size() != 1)
        return Error{
            "model '" + model.name() + "': its tone map looks at " + std::to_string(model.kernel_size()) + " x " +
            std::to_string(model.kernel_size()) +
            " pixels, and a table holds single colours: needs a model with kernel size 1, such as 'default'"
        };
    if (Status status = check_parameters(parameters, model); !status)
        return status;
    return guarded("tone map", {}, [&]() -> Status {
        const ToneDictionary& dictionary =
            direction == Direction::reverse ? model_data(model).tone_reverse : model_data(model).tone_forward;
        Layers layers;
        for (int l = 0; l < kToneLayers; ++l)
            layers[l] = mix_layer(dictionary[l], parameters.tone_weights[l]);
        const std::int64_t blocks = (count + kBlock - 1) / kBlock;
        const auto work = [&](std::int64_t block) {
            const std::int64_t first = block * kBlock;
            run_block(layers, rgb + 3 * first, static_cast<int>(std::min<std::int64_t>(kBlock, count - first)),
                      out + 3 * first);
        };
        parallel_tasks(blocks, 0, work);
        return {};
    });
}

} // namespace srisp
