// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "kernels/color_blocks.h"
#include "lib/kernels/test_planes.h"

using namespace srisp;

TEST_CASE("what follows and what comes before the tone map is the same on every instruction set as in plain C++")
{
    ColorBlocks blocks{ { 1.6f, -0.4f, -0.2f, -0.3f, 1.5f, -0.2f, 0.05f, -0.6f, 1.55f },
                        2.2f,
                        { 0.5f, 1.0f, 1.7f },
                        { 0.8f, 0.8f, 0.8f },
                        false };
    check_same(
        0, 1, 5e-6, [&](auto... a) { after_tone_map(blocks, a...); },
        [&](auto... a) { scalar::after_tone_map(blocks, a...); });
    for (const bool rebuilds : { false, true })
        for (const float low : { -0.1f, 0.9f }) {
            blocks.exponent = 1 / 2.2f;
            blocks.rebuilds_highlights = rebuilds;
            check_same(
                low, 1.1f, 5e-6, [&](auto... a) { before_tone_map(blocks, a...); },
                [&](auto... a) { scalar::before_tone_map(blocks, a...); });
        }
}

TEST_CASE("white that a RAW has clipped is rebuilt, greys the more the brighter, and other colours are left alone")
{
    // What a sensor records of greys, 1 / 0.6 the brightest, and of an orange.
    const float gain = 0.6f;
    const ColorBlocks blocks{ { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, 1, { 2, 1, 1.25f }, { gain, gain, gain }, true };
    const float* const balance = blocks.white_balance;
    constexpr int kGreys = 101;
    TestPlanes in{ kGreys + 1 };
    for (int c = 0; c < 3; ++c) {
        for (int x = 0; x < kGreys; ++x)
            in.planes().plane(c)[x] = std::min(x / (kGreys - 1.0f) / gain / balance[c], 1.0f);
        in.planes().plane(c)[kGreys] = (c == 0 ? 0.8f : 0.3f * (2 - c)) / balance[c];
    }
    on_each_instruction_set([&] {
        TestPlanes out{ in.count };
        before_tone_map(blocks, in.planes(), out.planes(), in.count);
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
