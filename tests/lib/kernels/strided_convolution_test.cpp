// SPDX-License-Identifier: Apache-2.0
#include "kernels/strided_convolution.h"

#include <doctest/doctest.h>

#include "each_target.h"
#include "image_compare.h"
#include "random_model.h"

using namespace srisp;

namespace {

struct Case {
    int inputs, outputs, size;
};

template<class Kernel> std::vector<float> convolved(const Case& c, bool relu, Kernel kernel)
{
    Random random(7);
    const EncoderLayer layer{ c.inputs, c.outputs, random_values(random, std::size_t(c.outputs) * c.inputs * 9),
                              random_values(random, c.outputs) };
    const std::ptrdiff_t in_row = std::ptrdiff_t(2 * c.size + 1) * c.inputs,
                         out_row = std::ptrdiff_t(c.size) * c.outputs;
    const std::vector<float> in = random_values(random, in_row * (2 * c.size + 1));
    std::vector<float> out(out_row * c.size);
    kernel(layer, StridedImages{ in.data(), in_row, out.data(), out_row, c.size, relu });
    return out;
}

} // namespace

TEST_CASE("a strided convolution is the same on every instruction set as in plain C++")
{
    for (const Case& c : { Case{ 3, 32, 32 }, Case{ 32, 64, 12 }, Case{ 128, 128, 3 }, Case{ 15, 32, 5 },
                           Case{ 64, 128, 2 }, Case{ 3, 32, 1 } })
        for (const bool relu : { false, true }) {
            const std::vector<float> expected = convolved(c, relu, strided_convolution_scalar);
            on_each_instruction_set([&] {
                const Difference difference = compare(
                    convolved(c, relu, [](const auto& l, const auto& i) { strided_convolution(l, i); }), expected);
                INFO(c.inputs, " to ", c.outputs, ", size ", c.size, ": ", difference.text);
                CHECK(difference.largest_relative <= 2e-5);
            });
        }
}

TEST_CASE("a layer with one weight takes its own tap and input to its own output")
{
    constexpr int inputs = 3, outputs = 64, size = 2, row = (2 * size + 1) * inputs;
    std::vector<float> in(row * (2 * size + 1));
    for (std::size_t i = 0; i < in.size(); ++i)
        in[i] = static_cast<float>(i);
    for (int ky = 0; ky < 3; ++ky)
        for (int kx = 0; kx < 3; ++kx) {
            EncoderLayer layer{ inputs, outputs, std::vector<float>(9 * inputs * outputs),
                                std::vector<float>(outputs, 0.25f) };
            // Output 37 is the sixth of the second group; it takes twice input 2.
            layer.weight[(((1 * 3 + ky) * 3 + kx) * inputs + 2) * kEncoderGroup + 5] = 2;
            std::vector<float> out(size * size * outputs);
            strided_convolution(layer, { in.data(), row, out.data(), size * outputs, size, false });
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    for (int o = 0; o < outputs; ++o)
                        CHECK(out[(y * size + x) * outputs + o] ==
                              0.25f + (o == 37 ? 2 * in[(2 * y + ky) * row + (2 * x + kx) * inputs + 2] : 0.0f));
        }
}
