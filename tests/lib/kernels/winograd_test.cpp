// SPDX-License-Identifier: Apache-2.0
#include "kernels/winograd.h"

#include <doctest/doctest.h>

#include "each_target.h"
#include "image_compare.h"
#include "random_model.h"

using namespace srisp;

TEST_CASE("six rows at once are the plain sums, on every instruction set and for widths that fill no block")
{
    constexpr int inputs = 32;
    Random random(11);
    for (const int outputs : { 32, 3 })
        for (const int width : { 1, 7, 90, 96, 100 }) {
            const ConvolutionWeights weights{ inputs, outputs, 9,
                                              random_values(random, std::size_t(outputs) * inputs * 9),
                                              random_values(random, outputs) };
            const std::ptrdiff_t stride = width + 2 + 2 * kRowSlack;
            const std::vector<float> in = random_values(random, kWinogradInputs * inputs * stride);
            std::vector<float> out(kWinogradOutputs * outputs * stride), expected(out.size());
            for (const bool relu : { false, true }) {
                WinogradRows rows{ {}, stride, {}, stride, width, relu };
                for (int k = 0; k < kWinogradInputs; ++k)
                    rows.in[k] = in.data() + k * inputs * stride;
                for (int k = 0; k < kWinogradOutputs; ++k) {
                    rows.out[k] = out.data() + k * outputs * stride;
                    ConvolutionRow row{ {}, stride, expected.data() + k * outputs * stride, stride, width, relu };
                    for (int t = 0; t < 9; ++t)
                        row.taps[t] = rows.in[k + t / 3] + t % 3;
                    convolve_row_scalar(pack_convolution(weights), row);
                }
                on_each_instruction_set([&] {
                    std::vector<float> scratch(winograd_scratch_size(inputs));
                    convolve_six_rows(pack_winograd(weights), rows, scratch.data());
                    std::vector<float> actual, wanted;
                    for (int row = 0; row < kWinogradOutputs * outputs; ++row)
                        for (int x = 0; x < width; ++x) {
                            actual.push_back(out[row * stride + x]);
                            wanted.push_back(expected[row * stride + x]);
                        }
                    const Difference difference = compare(actual, wanted);
                    INFO(outputs, " outputs, width ", width, ": ", difference.text);
                    CHECK(difference.largest_relative <= 5e-5);
                });
            }
        }
}
