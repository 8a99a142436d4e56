// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "each_target.h"
#include "image_compare.h"
#include "kernels/convolution.h"
#include "random_model.h"

using namespace srisp;

namespace {

struct Case {
    int inputs, outputs, taps, width;
};

template<class Kernel> std::vector<float> convolved(const Case& c, bool relu, Kernel kernel)
{
    Random random(7);
    const std::vector<float> weights = random_values(random, std::size_t(c.outputs) * c.inputs * c.taps);
    const std::vector<float> bias = random_values(random, c.outputs);
    const std::ptrdiff_t in_stride = c.width + 2 + kRowSlack, out_stride = c.width + kRowSlack;
    const std::vector<float> in = random_values(random, 3 * c.inputs * in_stride);
    std::vector<float> out(c.outputs * out_stride, 99.0f);
    ConvolutionRow row{ {}, in_stride, out.data(), out_stride, c.width, relu };
    for (int t = 0; t < c.taps; ++t)
        row.taps[t] = in.data() + t / 3 * c.inputs * in_stride + t % 3;
    kernel(pack_convolution({ c.inputs, c.outputs, c.taps, weights, bias }), row);
    std::vector<float> used;
    for (int o = 0; o < c.outputs; ++o)
        used.insert(used.end(), out.begin() + o * out_stride, out.begin() + o * out_stride + c.width);
    return used;
}

} // namespace

TEST_CASE("a convolution row is the same on every instruction set as in plain C++")
{
    for (const Case& c : { Case{ 3, 32, 9, 194 }, Case{ 32, 32, 9, 192 }, Case{ 32, 3, 9, 188 }, Case{ 32, 3, 1, 5 },
                           Case{ 15, 32, 9, 128 }, Case{ 128, 128, 9, 8 }, Case{ 3, 6, 1, 1 }, Case{ 4, 4, 9, 49 } })
        for (const bool relu : { false, true }) {
            const std::vector<float> expected = convolved(c, relu, convolve_row_scalar);
            on_each_instruction_set([&] {
                const Difference difference =
                    compare(convolved(c, relu, [](const auto& l, const auto& r) { convolve_row(l, r); }), expected);
                INFO(c.inputs, " to ", c.outputs, ", ", c.taps, " taps, width ", c.width, ": ", difference.text);
                CHECK(difference.largest_relative <= 2e-5);
            });
        }
}

TEST_CASE("a kernel with one weight picks its own tap and channel")
{
    for (int tap = 0; tap < 9; ++tap) {
        std::vector<float> weights(2 * 3 * 9, 0.0f);
        weights[(1 * 3 + 2) * 9 + tap] = 2; // output 1 takes twice input 2 at this tap
        const std::vector<float> bias = { 0.25f, 0 };
        std::vector<float> in(3 * 9 * 2 * kRowSlack), out(2 * 2 * kRowSlack);
        for (std::size_t i = 0; i < in.size(); ++i)
            in[i] = static_cast<float>(i);
        ConvolutionRow row{ {}, 2 * kRowSlack, out.data(), 2 * kRowSlack, 4, false };
        for (int t = 0; t < 9; ++t)
            row.taps[t] = in.data() + t * 3 * 2 * kRowSlack;
        convolve_row(pack_convolution({ 3, 2, 9, weights, bias }), row);
        for (int x = 0; x < 4; ++x) {
            CHECK(out[x] == 0.25f);
            CHECK(out[2 * kRowSlack + x] == 2 * row.taps[tap][2 * 2 * kRowSlack + x]);
        }
    }
}
