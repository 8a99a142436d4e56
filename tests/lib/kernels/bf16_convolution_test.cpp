// SPDX-License-Identifier: Apache-2.0
#include "kernels/bf16_convolution.h"

#include <doctest/doctest.h>

#include "image_compare.h"
#include "random_model.h"
#include "skip_unless.h"

using namespace srisp;

namespace {

/// Planes of floats in the form in which a layer reads them: plain, or two in the place of one.
std::vector<float> in_pairs(const std::vector<float>& planes, int channels, std::ptrdiff_t stride)
{
    std::vector<float> pairs;
    for (int c = 0; c < channels; c += 2)
        for (std::ptrdiff_t x = 0; x < stride; ++x)
            pairs.push_back(bf16_pair(planes[c * stride + x], planes[(c + 1) * stride + x]));
    return pairs;
}

/// What bf16 leaves of each number.
std::vector<float> rounded(std::vector<float> values)
{
    for (float& v : values)
        v = even_of_pair(bf16_pair(v, 0));
    return values;
}

struct Layer {
    ConvolutionWeights weights;
    std::ptrdiff_t stride;
    std::vector<float> in; ///< three rows of planes

    Layer(int inputs, int outputs, int width) : stride(width + 2 + kRowSlack)
    {
        Random random(inputs * 1000 + outputs + width);
        weights = { inputs, outputs, 9, random_values(random, std::size_t(outputs) * inputs * 9),
                    random_values(random, outputs) };
        in = random_values(random, 3 * inputs * stride);
    }

    ConvolutionRow row(const std::vector<float>& from, int planes, int width, bool relu, std::vector<float>& out) const
    {
        ConvolutionRow row{ {}, stride, out.data(), stride, width, relu };
        for (int t = 0; t < 9; ++t)
            row.taps[t] = from.data() + t / 3 * planes * stride + t % 3;
        return row;
    }
};

std::vector<float> first_pixels(const std::vector<float>& planes, std::ptrdiff_t stride, int width)
{
    std::vector<float> result;
    for (std::size_t plane = 0; plane < planes.size(); plane += stride)
        result.insert(result.end(), planes.begin() + plane, planes.begin() + plane + width);
    return result;
}

} // namespace

TEST_CASE("a pair holds two numbers, each rounded to the nearest bf16, ties to even")
{
    const float pair = bf16_pair(1.0f, -2.5f);
    CHECK(even_of_pair(pair) == 1.0f);
    CHECK(odd_of_pair(pair) == -2.5f);
    CHECK(even_of_pair(bf16_pair(1 + 1.0f / 256, 0)) == 1.0f); // half way between 1 and 1 + 1/128
    CHECK(even_of_pair(bf16_pair(1 + 3.0f / 256, 0)) == 1 + 1.0f / 64);
    CHECK(odd_of_pair(bf16_pair(0, 1 + 1.01f / 256)) == 1 + 1.0f / 128);
}

TEST_CASE("layers in bf16 are the plain sums of rounded numbers, for widths that fill no block")
{
    SKIP_UNLESS(has_bf16(), "a processor with AVX-512 BF16");
    for (const int width : { 1, 16, 17, 33, 100, 384 })
        for (const bool relu : { false, true }) {
            INFO("width ", width, relu ? ", relu" : "");
            const auto check = [&](const Layer& layer, bool pairs_in, bool pairs_out) {
                const int inputs = layer.weights.inputs, outputs = layer.weights.outputs;
                ConvolutionWeights weights = layer.weights;
                std::vector<float> in = layer.in;
                if (pairs_in) {
                    weights.weight = rounded(weights.weight);
                    in = rounded(in);
                }
                std::vector<float> expected(outputs * layer.stride);
                convolve_row_scalar(pack_convolution(weights), layer.row(in, inputs, width, relu, expected));
                if (pairs_out)
                    expected = rounded(expected);

                std::vector<float> given = layer.in, out((pairs_out ? outputs / 2 : outputs) * layer.stride);
                if (pairs_in)
                    given = in_pairs(given, 3 * inputs, layer.stride);
                const auto kernel = !pairs_in   ? convolve_floats_to_pairs
                                    : pairs_out ? convolve_pairs_to_pairs
                                                : convolve_pairs_to_floats;
                kernel(pairs_in ? pack_bf16(layer.weights) : pack_convolution(layer.weights),
                       layer.row(given, pairs_in ? inputs / 2 : inputs, width, relu, out));
                std::vector<float> actual = out;
                if (pairs_out) {
                    actual.clear();
                    for (int plane = 0; plane < outputs; ++plane)
                        for (std::ptrdiff_t x = 0; x < layer.stride; ++x) {
                            const float pair = out[plane / 2 * layer.stride + x];
                            actual.push_back(plane % 2 ? odd_of_pair(pair) : even_of_pair(pair));
                        }
                }
                const Difference difference =
                    compare(first_pixels(actual, layer.stride, width), first_pixels(expected, layer.stride, width));
                INFO(inputs, " to ", outputs, ": ", difference.text);
                // A sum that lies between two bf16 may be rounded to either.
                CHECK(difference.largest_relative <= (pairs_out ? 1.0 / 128 : 2e-5));
            };
            check(Layer(3, 32, width), false, true);
            check(Layer(32, 32, width), true, true);
            check(Layer(32, 3, width), true, false);
            check(Layer(32, 8, width), true, false);
        }
}
