// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <doctest/doctest.h>

#include "each_target.h"
#include "image_compare.h"
#include "kernels/pointwise.h"
#include "random_model.h"

using namespace srisp;

namespace {

/// Three planes with the room that the kernels need.
struct TestPlanes {
    std::size_t count;
    std::vector<float> values = std::vector<float>(3 * (count + kRowSlack));

    Planes planes() { return { values.data(), static_cast<std::ptrdiff_t>(count + kRowSlack) }; }
    std::vector<float> used()
    {
        std::vector<float> result;
        for (int c = 0; c < 3; ++c)
            result.insert(result.end(), planes().plane(c), planes().plane(c) + count);
        return result;
    }
};

TestPlanes random_planes(std::size_t count, float low, float high)
{
    TestPlanes image{ count };
    Random random(3);
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < count; ++x)
            image.planes().plane(c)[x] = random.uniform(low, high);
    return image;
}

template<class Vector, class Scalar>
void check_same(float low, float high, double tolerance, Vector vector, Scalar plain)
{
    TestPlanes in = random_planes(997, low, high), expected{ 997 };
    plain(in.planes(), expected.planes(), in.count);
    on_each_instruction_set([&] {
        TestPlanes out{ in.count };
        vector(in.planes(), out.planes(), in.count);
        const Difference difference = compare(out.used(), expected.used());
        INFO(difference.text);
        CHECK(difference.largest_relative <= tolerance);
        TestPlanes in_place = in;
        vector(in_place.planes(), in_place.planes(), in.count);
        CHECK(in_place.used() == out.used());
    });
}

} // namespace

TEST_CASE("colour transform, gains and inverse gains are the same on every instruction set as in plain C++")
{
    const Matrix3 matrix{ 1.6f, -0.4f, -0.2f, -0.3f, 1.5f, -0.2f, 0.05f, -0.6f, 1.55f };
    check_same(
        -0.1f, 1.2f, 1e-6, [&](auto... a) { color_transform(a..., matrix); },
        [&](auto... a) { scalar::color_transform(a..., matrix); });
    const float gains[] = { 2.0f, 1.0f, 1.4f }, scales[] = { 0.5f, 1.0f, 1.7f };
    check_same(
        0, 1, 1e-6, [&](auto... a) { multiply(a..., gains); }, [&](auto... a) { scalar::multiply(a..., gains); });
    check_same(
        0, 1.3f, 2e-6, [&](auto... a) { inverse_gain(a..., scales); },
        [&](auto... a) { scalar::inverse_gain(a..., scales); });
    for (const float low : { -0.1f, 0.9f })
        check_same(
            low, 1.1f, 2e-6, [&](auto... a) { rebuild_highlights(a..., gains, 0.7f); },
            [&](auto... a) { scalar::rebuild_highlights(a..., gains, 0.7f); });
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
            power(in.planes(), out.planes(), in.count, exponent, 1e-8f, 0);
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
    power(in.planes(), out.planes(), 3, 2.2f, 1e-8f, 0);
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

TEST_CASE("white that a RAW has clipped is rebuilt, greys the more the brighter, and other colours are left alone")
{
    // What a sensor records of greys, 1 / 0.6 the brightest, and of an orange.
    const float balance[] = { 2.0f, 1.0f, 1.25f }, gain = 0.6f;
    constexpr int kGreys = 101;
    TestPlanes in{ kGreys + 1 };
    for (int c = 0; c < 3; ++c) {
        for (int x = 0; x < kGreys; ++x)
            in.planes().plane(c)[x] = std::min(x / (kGreys - 1.0f) / gain / balance[c], 1.0f);
        in.planes().plane(c)[kGreys] = (c == 0 ? 0.8f : 0.3f * (2 - c)) / balance[c];
    }
    on_each_instruction_set([&] {
        TestPlanes out{ in.count };
        rebuild_highlights(in.planes(), out.planes(), in.count, balance, gain);
        for (int c = 0; c < 3; ++c) {
            const float* const result = out.planes().plane(c);
            for (int x = 0; x < kGreys; ++x) {
                const double grey = x / (kGreys - 1.0), above = std::max(0.0, (grey - 0.6) / 0.4); // 0.6: green clips
                const double clipped = std::min(grey, gain * (c == 0 ? 2 : c == 1 ? 1 : 1.25));
                CHECK(result[x] == doctest::Approx(clipped + above * above * (grey - clipped)).epsilon(1e-5));
            }
            CHECK(result[kGreys - 1] == doctest::Approx(1));
            CHECK(result[kGreys] == doctest::Approx(gain * (c == 0 ? 0.8 : 0.3 * (2 - c))));
        }
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
