// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispeval/pixels.h"

#include <doctest/doctest.h>

using namespace srisp;
using namespace srisp::tool;

namespace {

/// Each value tells where it is.
Pixels numbered(int width, int height)
{
    Pixels pixels(width, height);
    for (std::size_t i = 0; i < pixels.rgb.size(); ++i)
        pixels.rgb[i] = float(i);
    return pixels;
}

float red(const Pixels& pixels, int x, int y)
{
    return pixels.view().pixel(x, y)[0];
}

} // namespace

TEST_CASE("an image made smaller keeps its means, and whole cells are the means of theirs")
{
    const Pixels pixels = numbered(30, 20), small = resized(pixels, 7, 6), half = resized(pixels, 15, 10);
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(small.means()[c] == doctest::Approx(pixels.means()[c]));
    CHECK(red(half, 0, 0) == doctest::Approx((0 + 3 + 90 + 93) / 4.0));
    CHECK(resized(pixels, 30, 20).rgb == pixels.rgb);
    CHECK(red(resized(pixels, 60, 40), 1, 1) == 0); // enlarging repeats
}

TEST_CASE("the longer side is what is asked for, and never more than there is")
{
    CHECK(reduced_size(6000, 4000, 512) == std::array<int, 2>{ 512, 341 });
    CHECK(reduced_size(4000, 6000, 512) == std::array<int, 2>{ 341, 512 });
    CHECK(reduced_size(300, 200, 512) == std::array<int, 2>{ 300, 200 });
    CHECK(reduced_size(6000, 4000, 0) == std::array<int, 2>{ 6000, 4000 });
    CHECK(reduced_size(6000, 3, 64) == std::array<int, 2>{ 64, 1 });
}

TEST_CASE("images are turned as EXIF says")
{
    // Stored: 0 1 / 2 3 / 4 5, by the number of the pixel.
    const Pixels stored = numbered(2, 3);
    const auto corners = [&](int orientation) {
        const Pixels turned = oriented(stored, orientation);
        return std::array<int, 4>{ turned.width, turned.height, int(red(turned, 0, 0) / 3),
                                   int(red(turned, turned.width - 1, 0) / 3) };
    };
    CHECK(corners(1) == std::array<int, 4>{ 2, 3, 0, 1 });
    CHECK(corners(2) == std::array<int, 4>{ 2, 3, 1, 0 });
    CHECK(corners(3) == std::array<int, 4>{ 2, 3, 5, 4 });
    CHECK(corners(4) == std::array<int, 4>{ 2, 3, 4, 5 });
    CHECK(corners(5) == std::array<int, 4>{ 3, 2, 0, 4 });
    CHECK(corners(6) == std::array<int, 4>{ 3, 2, 4, 0 }); // a quarter clockwise
    CHECK(corners(7) == std::array<int, 4>{ 3, 2, 5, 1 });
    CHECK(corners(8) == std::array<int, 4>{ 3, 2, 1, 5 });
    CHECK(corners(0) == corners(1));
}
