// SPDX-License-Identifier: Apache-2.0
#include "recipe/photo_size.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

bool is(PhotoSize size, int width, int height)
{
    return size.width == width && size.height == height;
}

} // namespace

TEST_CASE("a photo's size is asked for by its shorter side, both, one or a percentage")
{
    const PhotoSize photo{ 4000, 3000 };
    CHECK(is(resized("480", photo), 640, 480));
    CHECK(is(resized("480", { 3000, 4000 }), 480, 640));
    CHECK(is(resized("512x512", photo), 512, 512));
    CHECK(is(resized("640x0", photo), 640, 480));
    CHECK(is(resized("0x480", photo), 640, 480));
    CHECK(is(resized("12.5%", photo), 500, 375));
    CHECK(is(resized("50%", { 1, 1 }), 1, 1));
    CHECK(is(resized("1", { 60000, 10 }), 6000, 1));
}

TEST_CASE("a crop is the middle, or by its seed anywhere")
{
    const auto middle = cropped("100x50", { 640, 480 }, 7);
    REQUIRE(middle);
    CHECK(middle->x == 270);
    CHECK(middle->y == 215);
    CHECK(middle->width == 100);
    CHECK(middle->height == 50);
    int least = 640, most = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const auto part = cropped("random:600", { 640, 600 }, seed);
        REQUIRE(part);
        CHECK(part->y == 0);
        least = std::min(least, part->x);
        most = std::max(most, part->x);
    }
    CHECK(least == 0);
    CHECK(most == 40);
    CHECK(cropped("random:480", { 640, 480 }, 3)->x == cropped("random:480", { 640, 480 }, 3)->x);
    const auto large = cropped("512", { 640, 480 }, 0);
    REQUIRE(!large);
    CHECK(large.error().message == "crop '512': the photo has only 640 x 480 pixels");
}

TEST_CASE("other texts are refused")
{
    for (const char* good : { "", "1", "65535", "640x0", "0x1", "3x4", "50%", "0.5%", "1000%" })
        CHECK_MESSAGE(check_resize(good), good);
    for (const char* wrong :
         { "0", "0x0", "-1", "1.5", "640x", "x480", "640X480", "65536", "0%", "-5%", "nan%", "%", "1001%", "big" })
        CHECK_MESSAGE(!check_resize(wrong), wrong);
    for (const char* good : { "", "1", "3x4", "random:1", "random:640x480" })
        CHECK_MESSAGE(check_crop(good), good);
    for (const char* wrong : { "0", "3x0", "0x3", "random:", "random", "random:0", "50%", "middle:3" })
        CHECK_MESSAGE(!check_crop(wrong), wrong);
    CHECK(check_resize("big").error().message ==
          "resize 'big' is not N (the shorter side), WxH, Wx0, 0xH or P%, up to 65535");
}
