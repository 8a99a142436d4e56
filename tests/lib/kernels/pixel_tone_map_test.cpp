// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "kernels/pixel_tone_map.h"
#include "lib/kernels/random_tone_map.h"
#include "lib/kernels/test_planes.h"

using namespace srisp;

TEST_CASE("a pointwise tone map is the same on every instruction set as in plain C++")
{
    const PixelToneMap tone_map = pack_pixel_tone_map(random_tone_layers());
    check_same(
        -0.1f, 1.1f, 2e-5, [&](auto... a) { tone_map_pixels(tone_map, a...); },
        [&](auto... a) { tone_map_in_plain_cpp(tone_map, a...); });
}

TEST_CASE("a pixel of a pointwise tone map has the same bits wherever it lies")
{
    const PixelToneMap tone_map = pack_pixel_tone_map(random_tone_layers());
    TestPlanes row = random_planes(200, 0, 1), all{ 200 };
    on_each_instruction_set([&] {
        tone_map_pixels(tone_map, row.planes(), all.planes(), row.count);
        for (std::size_t x = 0; x < row.count; ++x) {
            TestPlanes one{ 1 };
            for (int c = 0; c < 3; ++c)
                one.planes().plane(c)[0] = row.planes().plane(c)[x];
            tone_map_pixels(tone_map, one.planes(), one.planes(), 1);
            bool same = true;
            for (int c = 0; c < 3; ++c)
                same &= one.planes().plane(c)[0] == all.planes().plane(c)[x];
            CHECK(same);
        }
    });
}
