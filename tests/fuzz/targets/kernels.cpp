// SPDX-License-Identifier: Apache-2.0
// Kernels on every instruction set that this machine has, held against plain C++.
#include <algorithm>

#include "kernel_check.h"
#include "kernels/color_blocks.h"
#include "kernels/convolution.h"
#include "kernels/pointwise.h"
#include "kernels/strided_convolution.h"
#include "reference/raw_pixels.h"

using namespace srisp;
using namespace srisp::fuzz;

namespace {

template<class Plain, class Vector>
void check_planes(const char* name, Image& in, double tolerance, const Plain& plain, const Vector& vector)
{
    std::vector<float> expected(3 * in.count);
    Image result(in.count);
    plain(in.planes(), result.planes(), in.count);
    result.take(expected);
    check_each_target(name, expected, tolerance, [&](std::vector<float>& out) {
        Image made(in.count);
        vector(in.planes(), made.planes(), in.count);
        made.take(out);
    });
}

void check_pointwise(Draws& draws)
{
    Image in = drawn_image(draws, -0.5f, 2);
    const Matrix3 matrix = drawn_matrix(draws);
    const float scales[] = { draws.within(0.3f, 2), draws.within(0.3f, 2), draws.within(0.3f, 2) };
    const float exponent = draws.within(0.3f, 5);
    check_planes(
        "color_transform", in, 1e-6, [&](auto... a) { scalar::color_transform(a..., matrix); },
        [&](auto... a) { color_transform(a..., matrix); });
    check_planes(
        "inverse_gain", in, 4e-6, [&](auto... a) { scalar::inverse_gain(a..., scales); },
        [&](auto... a) { inverse_gain(a..., scales); });
    check_planes(
        "power", in, 2e-6, [&](auto... a) { scalar::power(a..., exponent, kPowerFloor); },
        [&](auto... a) { power(a..., exponent, kPowerFloor); });
}

void check_blocks(Draws& draws)
{
    ColorBlocks blocks{};
    blocks.color = drawn_matrix(draws);
    blocks.exponent = draws.within(1, 3);
    const float gain = draws.within(0.5f, 2);
    for (int c = 0; c < 3; ++c) {
        blocks.white_balance[c] = draws.within(0.4f, 2.5f);
        blocks.gain[c] = gain;
    }
    Image in = drawn_image(draws, 0, 1);
    check_planes(
        "after_tone_map", in, 1e-5, [&](auto... a) { scalar::after_tone_map(blocks, a...); },
        [&](auto... a) { after_tone_map(blocks, a...); });
    blocks.rebuilds_highlights = gain < 0.999f && draws.flag(); // beside 1 the formula magnifies the last bit
    blocks.exponent = 1 / blocks.exponent;
    // Powers below 1 magnify the last bit of what is nearly black.
    check_planes(
        "before_tone_map", in, 1e-3, [&](auto... a) { scalar::before_tone_map(blocks, a...); },
        [&](auto... a) { before_tone_map(blocks, a...); });
}

void check_convolution(Draws& draws)
{
    const int inputs = 1 + draws.below(34), outputs = 1 + draws.below(34), taps = draws.flag() ? 9 : 1;
    const int width = 1 + draws.below(100);
    const PackedConvolution layer =
        pack_convolution({ inputs, outputs, taps, drawn_values(draws, std::size_t(outputs * inputs * taps)),
                           drawn_values(draws, std::size_t(outputs)) });
    const std::ptrdiff_t in_stride = width + 2 + kRowSlack, out_stride = width + kRowSlack;
    const std::vector<float> in = drawn_values(draws, std::size_t(3 * inputs * in_stride));
    const bool relu = draws.flag();
    const auto run = [&](auto kernel, std::vector<float>& out) {
        std::vector<float> rows(std::size_t(outputs * out_stride));
        ConvolutionRow row{ {}, in_stride, rows.data(), out_stride, width, relu };
        for (int t = 0; t < taps; ++t)
            row.taps[t] = in.data() + t / 3 * inputs * in_stride + t % 3;
        kernel(layer, row);
        for (int o = 0; o < outputs; ++o)
            std::copy_n(&rows[std::size_t(o * out_stride)], width, &out[std::size_t(o * width)]);
    };
    std::vector<float> expected(std::size_t(outputs * width));
    run(convolve_row_scalar, expected);
    check_each_target("convolve_row", expected, 3e-5, [&](std::vector<float>& out) { run(convolve_row, out); });
}

void check_strided(Draws& draws)
{
    const int inputs = 1 + draws.below(40), outputs = kEncoderGroup * (1 + draws.below(2)), size = 1 + draws.below(9);
    const EncoderLayer layer{ inputs, outputs, drawn_values(draws, std::size_t(outputs * inputs * 9)),
                              drawn_values(draws, std::size_t(outputs)) };
    const std::ptrdiff_t in_row = std::ptrdiff_t(2 * size + 1) * inputs, out_row = std::ptrdiff_t(size) * outputs;
    const std::vector<float> in = drawn_values(draws, std::size_t(in_row * (2 * size + 1)));
    const bool relu = draws.flag();
    std::vector<float> expected(std::size_t(out_row * size));
    strided_convolution_scalar(layer, { in.data(), in_row, expected.data(), out_row, size, relu });
    check_each_target("strided_convolution", expected, 3e-5, [&](std::vector<float>& out) {
        strided_convolution(layer, { in.data(), in_row, out.data(), out_row, size, relu });
    });
}

void check_shorts(Draws& draws)
{
    const std::size_t count = std::size_t(1 + draws.below(100));
    std::vector<std::uint16_t> source;
    std::vector<float> black, factor, expected;
    for (std::size_t i = 0; i < count; ++i) {
        source.push_back(draws.number<std::uint16_t>());
        black.push_back(draws.within(0, 60000));
        factor.push_back(1 / (65535 - black.back()));
        expected.push_back(std::min(std::max((float(source[i]) - black[i]) * factor[i], 0.0f), 1.0f));
    }
    check_each_target("scale_shorts", expected, 0, [&](std::vector<float>& out) {
        scale_shorts(source.data(), black.data(), factor.data(), count, out.data());
    });
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Draws draws(data, size);
    constexpr void (*kChecks[])(Draws&) = { check_pointwise, check_blocks, check_convolution, check_strided,
                                            check_shorts };
    kChecks[draws.below(5)](draws);
    return 0;
}
