// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <doctest/doctest.h>

#include "each_target.h"
#include "kernels/pointwise.h"
#include "lib/kernels/test_planes.h"

using namespace srisp;

TEST_CASE("colour transform and inverse gains are the same on every instruction set as in plain C++")
{
    const Matrix3 matrix{ 1.6f, -0.4f, -0.2f, -0.3f, 1.5f, -0.2f, 0.05f, -0.6f, 1.55f };
    check_same(
        -0.1f, 1.2f, 1e-6, [&](auto... a) { color_transform(a..., matrix); },
        [&](auto... a) { scalar::color_transform(a..., matrix); });
    const float scales[] = { 0.5f, 1.0f, 1.7f };
    check_same(
        0, 1.3f, 2e-6, [&](auto... a) { inverse_gain(a..., scales); },
        [&](auto... a) { scalar::inverse_gain(a..., scales); });
}

TEST_CASE("power is within 1e-6 (relative) of the exact value for every exponent of the pipeline")
{
    for (const float exponent : { 1 / 3.4f, 1 / 2.2f, 1.0f, 1.6f, 2.2f, 3.4f, 5.0f }) {
        TestPlanes in{ 100000 };
        for (int c = 0; c < 3; ++c)
            for (std::size_t x = 0; x < in.count; ++x) // 1e-8 … 20, evenly in the exponent, and finely near 1
                in.planes().plane(c)[x] =
                    c < 2 ? std::exp(-18.42f + 21.4f * (x + 0.5f * c) / in.count) : 0.9f + 0.2f * x / in.count;
        on_each_instruction_set([&] {
            TestPlanes out{ in.count };
            power(in.planes(), out.planes(), in.count, exponent, 1e-8f);
            double largest = 0;
            for (int c = 0; c < 3; ++c)
                for (std::size_t x = 0; x < in.count; ++x) {
                    const double exact = std::pow(double(in.planes().plane(c)[x]), double(exponent));
                    if (exact > 1e-30) // below, results end at the smallest normal float
                        largest = std::max(largest, std::abs(out.planes().plane(c)[x] / exact - 1));
                }
            INFO("exponent ", exponent, ", largest relative error ", largest);
            CHECK(largest <= 1e-6);
        });
    }
}

TEST_CASE("power takes what lies below the floor as the floor, and one and zero exactly")
{
    TestPlanes in{ 3 }, out{ 3 };
    for (int c = 0; c < 3; ++c)
        std::copy_n(std::vector<float>{ -1, 0, 1 }.data(), 3, in.planes().plane(c));
    power(in.planes(), out.planes(), 3, 2.2f, 1e-8f);
    CHECK(out.planes().plane(0)[0] == out.planes().plane(0)[1]);
    CHECK(out.planes().plane(0)[0] == doctest::Approx(2.5118864e-18).epsilon(1e-5));
    CHECK(out.planes().plane(2)[2] == 1.0f);
}

TEST_CASE("the highlight-preserving inverse gain has the published values and keeps white white")
{
    // g = 1.25, (g_r, g_b) = (2, 1.6), as one gain vector [method 4, golden values]
    const float scales[] = { 1 / 2.5f, 1 / 1.25f, 1 / 2.0f };
    const float in_rgb[3][3] = { { 0.2f, 0.4f, 0.6f }, { 0.95f, 0.95f, 0.95f }, { 1, 1, 1 } };
    const float expected[3][3] = { { 0.08f, 0.32f, 0.3f }, { 0.5225f, 0.8075f, 0.59375f }, { 1, 1, 1 } };
    on_each_instruction_set([&] {
        TestPlanes image{ 3 };
        for (int c = 0; c < 3; ++c)
            for (int x = 0; x < 3; ++x)
                image.planes().plane(c)[x] = in_rgb[x][c];
        inverse_gain(image.planes(), image.planes(), 3, scales);
        for (int c = 0; c < 3; ++c)
            for (int x = 0; x < 3; ++x)
                CHECK(image.planes().plane(c)[x] == doctest::Approx(expected[x][c]).epsilon(2e-6));
    });
}

TEST_CASE("interleaved pixels go to planes and back, and nothing past the last is touched")
{
    for (const std::size_t count : { 1, 7, 16, 100 })
        on_each_instruction_set([&] {
            INFO(count, " pixels");
            std::vector<float> rgb(3 * count), back(3 * count + 3, -1.0f);
            for (std::size_t i = 0; i < rgb.size(); ++i)
                rgb[i] = static_cast<float>(i);
            TestPlanes planes{ count };
            split_channels(rgb.data(), planes.planes(), count);
            for (int c = 0; c < 3; ++c)
                CHECK(planes.planes().plane(c)[count - 1] == 3 * (count - 1) + c);
            join_channels(planes.planes(), back.data(), count);
            CHECK(std::equal(rgb.begin(), rgb.end(), back.begin()));
            CHECK(back[3 * count] == -1.0f);
        });
}

TEST_CASE("powers of undone gains, from the image's own powers, are those of the blocks one after another")
{
    const float scales[] = { 0.4f, 1.0f, 1.9f }, exponent = 1 / 2.2f, floor = 1e-5f;
    for (const float brightest : { 0.8f, 1.3f }) // without highlights, and with
        check_same(
            0, brightest, 3e-6,
            [&](Planes in, Planes out, std::size_t count) {
                TestPlanes powers{ count };
                power(in, powers.planes(), count, exponent, 1e-30f);
                power_of_inverse_gain(in, powers.planes(), out, count, scales, exponent, floor);
            },
            [&](Planes in, Planes out, std::size_t count) {
                scalar::inverse_gain(in, out, count, scales);
                scalar::power(out, out, count, exponent, floor);
            });
}

TEST_CASE("powers of undone gains end at that of the floor")
{
    const float scales[] = { 0.5f, 0.5f, 0.5f };
    TestPlanes in{ 2 }, powers{ 2 }, out{ 2 };
    in.planes().plane(0)[1] = 1e-5f; // halved it is below the floor; the rest is 0
    power(in.planes(), powers.planes(), 2, 1 / 2.2f, 1e-30f);
    power_of_inverse_gain(in.planes(), powers.planes(), out.planes(), 2, scales, 1 / 2.2f, 1e-5f);
    for (const float value : out.used())
        CHECK(value == doctest::Approx(std::pow(1e-5, 1 / 2.2)).epsilon(1e-6));
}
