// SPDX-License-Identifier: Apache-2.0
// Kernels on every instruction set that this machine has, held against plain C++.
#include <algorithm>
#include <cmath>

#include "force_targets.h"
#include "fuzz_target.h"
#include "kernels/color_blocks.h"
#include "kernels/convolution.h"
#include "kernels/pointwise.h"
#include "kernels/strided_convolution.h"
#include "reference/raw_pixels.h"

using namespace srisp;

namespace {

/// Calls `vector`, which fills its argument, for each instruction set; `expected` is what plain C++ makes.
template<class Vector>
void check_each_target(const char* kernel, const std::vector<float>& expected, double tolerance, const Vector& vector)
{
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        force_targets(target);
        std::vector<float> out(expected.size());
        vector(out);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double difference = std::fabs(double(out[i]) - double(expected[i]));
            if (!(difference <= tolerance * std::max(1.0, std::fabs(double(expected[i])))))
                fuzz::must_hold(false, "kernels are the same as in plain C++",
                                std::string(kernel) + " on " + hwy::TargetName(target) + ": " + std::to_string(out[i]) +
                                    " against " + std::to_string(expected[i]));
        }
    }
    force_targets(0);
}

/// Three planes of `count` pixels with the room that kernels need; only the pixels are taken out again.
struct Image {
    std::size_t count;
    std::vector<float> values;

    explicit Image(std::size_t pixels) : count(pixels), values(3 * (pixels + kRowSlack)) {}
    Planes planes() { return { values.data(), std::ptrdiff_t(count + kRowSlack) }; }
    void take(std::vector<float>& out)
    {
        for (std::size_t c = 0; c < 3; ++c)
            std::copy_n(planes().plane(int(c)), count, out.begin() + std::ptrdiff_t(c * count));
    }
};

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

Image drawn_image(fuzz::Draws& draws, float low, float high)
{
    Image image(std::size_t(1 + draws.below(70)));
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < image.count; ++x)
            image.planes().plane(c)[x] = draws.within(low, high);
    return image;
}

Matrix3 drawn_matrix(fuzz::Draws& draws)
{
    Matrix3 matrix{};
    for (std::size_t i = 0; i < 9; ++i)
        matrix[i] = draws.within(-0.6f, 0.6f) + (i % 4 == 0 ? 1 : 0);
    return matrix;
}

void check_pointwise(fuzz::Draws& draws)
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

void check_blocks(fuzz::Draws& draws)
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

std::vector<float> drawn_values(fuzz::Draws& draws, std::size_t count)
{
    std::vector<float> values(count);
    std::uint32_t state = draws.number<std::uint32_t>();
    for (float& value : values) {
        state = state * 1664525 + 1013904223;
        value = float(int(state >> 8) - (1 << 23)) / float(1 << 23);
    }
    return values;
}

void check_convolution(fuzz::Draws& draws)
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

void check_strided(fuzz::Draws& draws)
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

void check_shorts(fuzz::Draws& draws)
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
    fuzz::Draws draws(data, size);
    constexpr void (*kChecks[])(fuzz::Draws&) = { check_pointwise, check_blocks, check_convolution, check_strided,
                                                  check_shorts };
    kChecks[draws.below(5)](draws);
    return 0;
}
