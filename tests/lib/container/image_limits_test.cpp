// SPDX-License-Identifier: Apache-2.0
#include "container/image_limits.h"

#include <climits>
#include <cstdlib>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

/// Empty: nothing is wrong.
std::string fault(const OIIO::ImageSpec& spec)
{
    const Status size = check_size(spec);
    return size ? "" : size.error().message;
}

OIIO::ImageSpec tiled(int width, int height)
{
    OIIO::ImageSpec spec(64, 48, 3, OIIO::TypeUInt8);
    spec.tile_width = width;
    spec.tile_height = height;
    return spec;
}

std::string claim_fault(const char* reader, std::uint64_t width, std::uint64_t height, std::uint64_t bytes)
{
    const Status claim = check_claim(reader, width, height, bytes);
    return claim ? "" : claim.error().message;
}

} // namespace

TEST_CASE("sides, channels and pixels have limits, which messages name")
{
    CHECK(fault({ 1, 1, 1, OIIO::TypeUInt8 }).empty());
    CHECK(fault({ 65500, 30000, 3, OIIO::TypeUInt8 }).empty());
    CHECK(fault({ 0, 0, 3, OIIO::TypeUInt8 }) == "has 0 x 0 pixels; from 1 to 1048576 a side are possible");
    CHECK(fault({ -5, 7, 3, OIIO::TypeUInt8 }) == "has -5 x 7 pixels; from 1 to 1048576 a side are possible");
    CHECK(fault({ INT_MAX, 1, 1, OIIO::TypeUInt8 }) ==
          "has 2147483647 x 1 pixels; from 1 to 1048576 a side are possible");
    CHECK(fault({ 65500, 65500, 3, OIIO::TypeUInt8 }) ==
          "has 65500 x 65500 pixels, which is more than the limit of 2000 million; SRISP_MAX_MEGAPIXELS in the "
          "environment sets another");
    CHECK(fault({ 64, 48, 100000, OIIO::TypeUInt8 }) ==
          "has a number of channels of 100000; from 1 to 1024 are possible");
    CHECK(fault({ 1 << 20, 48, 1000, OIIO::TypeUInt8 }).find("rows of 1048576 pixels of 1000 channels") !=
          std::string::npos);
    OIIO::ImageSpec volume(1000, 1000, 1, OIIO::TypeUInt8);
    volume.depth = 100000;
    CHECK(fault(volume).find("volume of 1000 x 1000 x 100000") != std::string::npos);
}

TEST_CASE("tiles may reach beyond an image, but not without end")
{
    CHECK(fault(tiled(64, 48)).empty());
    CHECK(fault(tiled(1024, 1024)).empty());
    CHECK(fault(tiled(16, 0x7ffffff0)).find("tiles of 16 x 2147483632 x 1 pixels") != std::string::npos);
    CHECK(fault(tiled(0x7ffffff0, 16)).find("tiles of 2147483632 x 16 x 1 pixels") != std::string::npos);
    CHECK(fault(tiled(16, -16)).find("tiles of 16 x -16") != std::string::npos);
    CHECK(fault(tiled(16, 0)).find("tiles of 16 x 0") != std::string::npos);
    CHECK(fault(tiled(1 << 20, 1 << 20)).find("more than the limit of 67108864 values") != std::string::npos);
}

TEST_CASE("windows far from the origin are refused")
{
    for (int OIIO::ImageSpec::*const edge : { &OIIO::ImageSpec::x, &OIIO::ImageSpec::y, &OIIO::ImageSpec::full_x,
                                              &OIIO::ImageSpec::full_y, &OIIO::ImageSpec::full_width }) {
        OIIO::ImageSpec spec(64, 48, 3, OIIO::TypeUInt8);
        spec.*edge = 12345;
        CHECK(fault(spec).empty());
        spec.*edge = INT_MIN;
        CHECK(fault(spec).find("-2147483648; from ") != std::string::npos);
        spec.*edge = INT_MAX;
        CHECK(fault(spec).find("2147483647; from ") != std::string::npos);
    }
}

TEST_CASE("the limit in megapixels is the user's")
{
    const OIIO::ImageSpec spec(65500, 65500, 3, OIIO::TypeUInt8);
    REQUIRE(::setenv("SRISP_MAX_MEGAPIXELS", "5000", 1) == 0);
    CHECK(fault(spec).empty());
    REQUIRE(::setenv("SRISP_MAX_MEGAPIXELS", "3", 1) == 0);
    CHECK(fault(spec).find("the limit of 3 million") != std::string::npos);
    REQUIRE(::setenv("SRISP_MAX_MEGAPIXELS", "", 1) == 0);
    CHECK(fault(spec).find("the limit of 2000 million") != std::string::npos);
    for (const std::string nonsense : { "0", "-1", "many", "5000x", "1000001", "99999999999999999999" }) {
        REQUIRE(::setenv("SRISP_MAX_MEGAPIXELS", nonsense.c_str(), 1) == 0);
        CHECK(fault(tiled(64, 48)) == "cannot be read: SRISP_MAX_MEGAPIXELS in the environment is '" + nonsense +
                                          "'; a whole number from 1 to 1000000 is possible");
    }
    ::unsetenv("SRISP_MAX_MEGAPIXELS");
}

TEST_CASE("a few bytes cannot be a large picture, but flat pictures are small files")
{
    for (const char* const reader : { "jpeg", "png", "tiff", "openexr", "heif", "psd", "jpeg2000", "gif" }) {
        CAPTURE(reader);
        CHECK(claim_fault(reader, 65500, 65500, 200)
                  .find("damaged or truncated: says that it has 65500 x 65500 "
                        "pixels, but has only 200 bytes") != std::string::npos);
        CHECK(claim_fault(reader, 4000, 4000, 200).empty()); // decoded in a moment
    }
    // What encoders make of 24 million black pixels.
    constexpr struct {
        const char* reader;
        std::uint64_t bytes;
    } flat[] = { { "jpeg", 375'953 / 6 }, { "png", 23'678 },  { "png", 3'000 },    { "tiff", 27'427 },
                 { "openexr", 10'887 },   { "heif", 15'100 }, { "heif", 915 },     { "jpeg2000", 457 },
                 { "webp", 60 },          { "psd", 400'000 }, { "targa", 380'000 } };
    for (const auto& each : flat) {
        CAPTURE(each.reader);
        CHECK(claim_fault(each.reader, 6000, 4000, each.bytes).empty());
    }
}

TEST_CASE("a strip has at most all rows")
{
    for (const int rows : { INT_MIN, -1, 0, 49, INT_MAX }) {
        OIIO::ImageSpec spec(64, 48, 3);
        spec.attribute("tiff:RowsPerStrip", rows);
        limit_strips(spec);
        CHECK(spec.get_int_attribute("tiff:RowsPerStrip") == 48);
    }
    OIIO::ImageSpec spec(64, 48, 3);
    spec.attribute("tiff:RowsPerStrip", 7);
    limit_strips(spec);
    CHECK(spec.get_int_attribute("tiff:RowsPerStrip") == 7);
}

TEST_CASE("rows to be read at a time are whole tiles, and no more than there are")
{
    CHECK(rows_in_tiles(10, tiled(64, 16)) == 16);
    CHECK(rows_in_tiles(17, tiled(64, 16)) == 32);
    CHECK(rows_in_tiles(1000, tiled(64, 16)) == 48);
    CHECK(rows_in_tiles(1, tiled(16, 0x7ffffff0)) == 48);
    CHECK(rows_in_tiles(10, OIIO::ImageSpec(64, 48, 3)) == 10);
}

TEST_CASE("a small image is read in parts, a large one by so many pixels, and always by one row at least")
{
    const auto rows = [](int width, int height, int parts) {
        return rows_of_part(300000, OIIO::ImageSpec(width, height, 3), parts);
    };
    CHECK(rows(640, 480, 4) == 120);
    CHECK(rows(640, 481, 2) == 241); // not three parts
    CHECK(rows(6000, 4000, 4) == 50);
    CHECK(rows(100, 80, 4) == 163); // all of a tiny one
    CHECK(rows(400000, 9, 4) == 1);
}
