// SPDX-License-Identifier: Apache-2.0
// The tone map's kernels on every instruction set that this machine has, held against plain C++: six rows at once, in
// bf16, and all of a pointwise model's pipeline.
#include <cstring>

#include "kernel_check.h"
#include "kernels/bf16_convolution.h"
#include "kernels/pixel_pipeline.h"
#include "kernels/pointwise.h"
#include "kernels/winograd.h"
#include "lib/kernels/random_tone_map.h"

using namespace srisp;
using namespace srisp::fuzz;

namespace {

/// A layer of nine taps, and the rows that it reads.
struct Layer {
    int inputs, outputs, width;
    std::ptrdiff_t stride;
    ConvolutionWeights weights;
    std::vector<float> in;
    bool relu;

    Layer(Draws& draws, int rows, int in_channels, int out_channels)
        : inputs(in_channels), outputs(out_channels), width(1 + draws.below(120)),
          stride(width + 2 + 2 * kRowSlack), weights{ inputs, outputs, 9,
                                                      drawn_values(draws, std::size_t(outputs * inputs * 9)),
                                                      drawn_values(draws, std::size_t(outputs)) },
          in(drawn_values(draws, std::size_t(rows * inputs * stride))), relu(draws.flag())
    {
    }
    /// Of the row `y` of the output, from `from`, whose rows have `planes` planes.
    ConvolutionRow row(const std::vector<float>& from, int planes, int y, std::vector<float>& out) const
    {
        ConvolutionRow row{ {}, stride, out.data(), stride, width, relu };
        for (int t = 0; t < 9; ++t)
            row.taps[t] = from.data() + (y + t / 3) * planes * stride + t % 3;
        return row;
    }
    std::vector<float> in_plain_cpp(int y) const
    {
        std::vector<float> out(std::size_t(outputs * stride));
        convolve_row_scalar(pack_convolution(weights), row(in, inputs, y, out));
        return out;
    }
    /// Appends what a row is to hold.
    void take(const std::vector<float>& planes, std::vector<float>& out) const
    {
        for (int o = 0; o < outputs; ++o)
            out.insert(out.end(), &planes[std::size_t(o * stride)], &planes[std::size_t(o * stride + width)]);
    }
};

void check_winograd(Draws& draws)
{
    const Layer layer(draws, kWinogradInputs, 1 + draws.below(34), 1 + draws.below(34));
    std::vector<float> expected;
    for (int y = 0; y < kWinogradOutputs; ++y)
        layer.take(layer.in_plain_cpp(y), expected);
    const WinogradConvolution packed = pack_winograd(layer.weights);
    check_each_target("convolve_six_rows", expected, 5e-4, [&](std::vector<float>& made) {
        std::vector<std::vector<float>> out(kWinogradOutputs, std::vector<float>(layer.outputs * layer.stride));
        WinogradRows rows{ {}, layer.stride, {}, layer.stride, layer.width, layer.relu };
        for (int k = 0; k < kWinogradInputs; ++k)
            rows.in[k] = layer.in.data() + k * layer.inputs * layer.stride;
        for (int k = 0; k < kWinogradOutputs; ++k)
            rows.out[k] = out[std::size_t(k)].data();
        std::vector<float> scratch(winograd_scratch_size(std::max(layer.inputs, layer.outputs)));
        convolve_six_rows(packed, rows, scratch.data());
        made.clear();
        for (const std::vector<float>& row : out)
            layer.take(row, made);
    });
}

/// What bf16 leaves of each number.
std::vector<float> rounded(std::vector<float> values)
{
    for (float& value : values)
        value = even_of_pair(bf16_pair(value, 0));
    return values;
}

/// Two planes in the place of one.
std::vector<float> in_pairs(const Layer& layer)
{
    std::vector<float> pairs;
    for (std::size_t begin = 0; begin < layer.in.size(); begin += std::size_t(2 * layer.stride))
        for (std::size_t x = begin; x < begin + std::size_t(layer.stride); ++x)
            pairs.push_back(bf16_pair(layer.in[x], layer.in[x + std::size_t(layer.stride)]));
    return pairs;
}

std::vector<float> out_of_pairs(const std::vector<float>& pairs, std::ptrdiff_t stride)
{
    std::vector<float> planes;
    for (std::size_t begin = 0; begin < pairs.size(); begin += std::size_t(stride))
        for (const auto part : { even_of_pair, odd_of_pair })
            for (std::size_t x = begin; x < begin + std::size_t(stride); ++x)
                planes.push_back(part(pairs[x]));
    return planes;
}

void check_bf16(Draws& draws)
{
    const bool pairs_in = draws.flag(), pairs_out = !pairs_in || draws.flag();
    Layer layer(draws, 3, pairs_in ? 2 + 2 * draws.below(17) : 1 + draws.below(34),
                pairs_out ? 2 + 2 * draws.below(17) : 1 + draws.below(34));
    const PackedConvolution packed = pairs_in ? pack_bf16(layer.weights) : pack_convolution(layer.weights);
    const std::vector<float> given = pairs_in ? in_pairs(layer) : layer.in;
    if (pairs_in) {
        layer.weights.weight = rounded(layer.weights.weight);
        layer.in = rounded(layer.in);
    }
    std::vector<float> expected;
    layer.take(pairs_out ? rounded(layer.in_plain_cpp(0)) : layer.in_plain_cpp(0), expected);
    const auto kernel = !pairs_in   ? convolve_floats_to_pairs
                        : pairs_out ? convolve_pairs_to_pairs
                                    : convolve_pairs_to_floats;
    // A sum that lies between two bf16 may be rounded to either.
    check_each_target("bf16", expected, pairs_out ? 1.0 / 128 : 5e-5, [&](std::vector<float>& made) {
        if (!has_bf16()) {
            made = expected;
            return;
        }
        std::vector<float> out(std::size_t(layer.outputs * layer.stride));
        kernel(packed, layer.row(given, pairs_in ? layer.inputs / 2 : layer.inputs, 0, out));
        if (pairs_out)
            out.resize(out.size() / 2);
        made.clear();
        layer.take(pairs_out ? out_of_pairs(out, layer.stride) : out, made);
    });
}

std::vector<float> by_blocks(const PixelPipeline& pipeline, bool forward, const std::vector<float>& rgb)
{
    Image image(rgb.size() / 3);
    const Planes v = image.planes();
    split_channels(rgb.data(), v, image.count);
    if (forward)
        scalar::before_tone_map(pipeline.blocks, v, v, image.count);
    tone_map_in_plain_cpp(pipeline.tone_map, v, v, image.count);
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < image.count; ++x)
            v.plane(c)[x] = std::clamp(v.plane(c)[x], 0.0f, 1.0f);
    if (!forward)
        scalar::after_tone_map(pipeline.blocks, v, v, image.count);
    std::vector<float> out(rgb.size());
    join_channels(v, out.data(), image.count);
    return out;
}

void check_pipeline(Draws& draws)
{
    static const PixelToneMap kToneMap = pack_pixel_tone_map(random_tone_layers());
    const bool forward = draws.flag();
    PixelPipeline pipeline{ kToneMap, {} };
    pipeline.blocks.color = drawn_matrix(draws);
    pipeline.blocks.exponent = forward ? 1 / draws.within(1, 3) : draws.within(1, 3);
    for (int c = 0; c < 3; ++c) {
        pipeline.blocks.white_balance[c] = draws.within(0.4f, 2.5f);
        pipeline.blocks.gain[c] = forward ? 0.8f : draws.within(0.5f, 2);
    }
    pipeline.blocks.rebuilds_highlights = forward && draws.flag();
    const std::size_t count = std::size_t(1 + draws.below(100)), begin = std::size_t(draws.below(int(count)));
    std::vector<float> rgb;
    for (std::size_t i = 0; i < 3 * count; ++i)
        rgb.push_back(draws.within(0, 1));
    const auto run = forward ? forward_pixels : reverse_pixels;
    // Powers below 1 magnify the last bit of what is nearly black, and so does the tone map behind them.
    const std::vector<float> expected = by_blocks(pipeline, forward, rgb);
    check_each_target("pixel_pipeline", expected, forward ? 2e-2 : 1e-3, [&](std::vector<float>& out) {
        run(pipeline, nullptr, rgb.data(), out.data(), count);
        // In memory of that size alone, and in place.
        std::vector<float> part(rgb.begin() + std::ptrdiff_t(3 * begin), rgb.end());
        run(pipeline, nullptr, part.data(), part.data(), count - begin);
        must_hold(std::memcmp(part.data(), &out[3 * begin], part.size() * sizeof(float)) == 0,
                  "a pixel has the same bits wherever it lies");
    });
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Draws draws(data, size);
    constexpr void (*kChecks[])(Draws&) = { check_winograd, check_bf16, check_pipeline };
    kChecks[draws.below(3)](draws);
    return 0;
}
