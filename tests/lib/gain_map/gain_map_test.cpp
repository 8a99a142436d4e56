// SPDX-License-Identifier: Apache-2.0
#include "gain_map/gain_map.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "ultra_hdr_jpeg.h"

using namespace srisp;

namespace {

GainMapInfo info_of(const UltraHdrJpeg& made)
{
    const auto found = find_gain_map(made.bytes());
    REQUIRE_MESSAGE(found, (found ? "" : found.error().message));
    REQUIRE(*found);
    return **found;
}

GainMap map_of(const GainMapInfo& info, const UltraHdrJpeg& made)
{
    auto map = GainMap::create(info, made.width, made.height);
    REQUIRE_MESSAGE(map, (map ? "" : map.error().message));
    return std::move(*map);
}

std::string creation_error(const GainMapInfo& info)
{
    const auto map = GainMap::create(info, 32, 24);
    return map ? "" : map.error().message;
}

/// The map's value in [0,1] at a pixel of the photo, as a mean of four pixels around it.
double map_value(const GainMapImage& map, const UltraHdrJpeg& made, int x, int y, int channel)
{
    const auto at = [&](int map_x, int map_y) {
        map_x = std::min(std::max(map_x, 0), map.width - 1);
        map_y = std::min(std::max(map_y, 0), map.height - 1);
        return map.row(map_y)[map_x * map.channels + (map.channels == 3 ? channel : 0)] / 255.0;
    };
    const double map_x = (x + 0.5) / made.width * map.width - 0.5, map_y = (y + 0.5) / made.height * map.height - 0.5;
    const int left = int(std::floor(map_x)), top = int(std::floor(map_y));
    const double right_part = map_x - left, lower_part = map_y - top;
    return (at(left, top) * (1 - right_part) + at(left + 1, top) * right_part) * (1 - lower_part) +
           (at(left, top + 1) * (1 - right_part) + at(left + 1, top + 1) * right_part) * lower_part;
}

/// The largest relative difference between `boosted` and the formula in double precision.
double largest_difference(const UltraHdrJpeg& made)
{
    const GainMapInfo info = info_of(made);
    const GainMap map = map_of(info, made);
    const auto image = decode_gain_map_image(info.jpeg);
    REQUIRE(image);
    REQUIRE(image->channels == made.map_channels);
    const GainMapMetadata& meta = info.metadata;
    double largest = 0;
    std::vector<float> sdr(std::size_t(made.width) * 3), hdr(sdr.size());
    for (int y = 0; y < made.height; ++y) {
        for (std::size_t i = 0; i < sdr.size(); ++i)
            sdr[i] = float(i + std::size_t(y)) / float(sdr.size() + std::size_t(made.height));
        map.boosted(y, sdr.data(), hdr.data());
        for (int x = 0; x < made.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double recovery = std::pow(map_value(*image, made, x, y, c), 1 / meta.gamma[c]);
                const double log_boost = meta.min[c] * (1 - recovery) + meta.max[c] * recovery;
                const double expected =
                    (sdr[3 * x + c] + meta.offset_sdr[c]) * std::pow(2, log_boost) - meta.offset_hdr[c];
                const double scale = (sdr[3 * x + c] + meta.offset_sdr[c]) * std::pow(2, log_boost);
                largest = std::max(largest, std::fabs(hdr[3 * x + c] - expected) / scale);
            }
    }
    return largest;
}

} // namespace

TEST_CASE("a photo is boosted as the formula says")
{
    UltraHdrJpeg plain;
    CHECK(largest_difference(plain) < 3e-6);

    UltraHdrJpeg gamma; // and no whole ratio of sizes
    gamma.width = 37;
    gamma.height = 23;
    gamma.map_attributes = R"(hdrgm:Version="1.0" hdrgm:GainMapMin="-1.5" hdrgm:GainMapMax="4" hdrgm:Gamma="2.2"
        hdrgm:OffsetSDR="0.01" hdrgm:OffsetHDR="0.02" hdrgm:HDRCapacityMax="4")";
    CHECK(largest_difference(gamma) < 3e-5);

    UltraHdrJpeg colors; // a map larger than the photo
    colors.map_channels = 3;
    colors.map_width = 50;
    colors.map_attributes = R"(hdrgm:Version="1.0" hdrgm:HDRCapacityMax="4")";
    colors.map_elements = "<hdrgm:GainMapMax><rdf:Seq><rdf:li>1</rdf:li><rdf:li>2</rdf:li><rdf:li>3.5</rdf:li>"
                          "</rdf:Seq></hdrgm:GainMapMax><hdrgm:Gamma>0.5</hdrgm:Gamma>";
    CHECK(largest_difference(colors) < 3e-6);

    UltraHdrJpeg grey_map_of_colors = colors;
    grey_map_of_colors.map_channels = 1;
    CHECK(largest_difference(grey_map_of_colors) < 3e-6);
}

TEST_CASE("where the map is full, light is boosted by its maximum, and at 0 by its minimum")
{
    UltraHdrJpeg made;
    made.map_attributes = R"(hdrgm:Version="1.0" hdrgm:GainMapMin="-1" hdrgm:GainMapMax="3" hdrgm:HDRCapacityMax="3"
        hdrgm:OffsetSDR="0" hdrgm:OffsetHDR="0")";
    const GainMap map = map_of(info_of(made), made);
    std::vector<float> row(32 * 3, 0.5f);
    map.boosted(11, row.data(), row.data());              // in place
    CHECK(row[0] == doctest::Approx(0.25).epsilon(0.02)); // the JPEG of the map errs
    CHECK(row[31 * 3 + 1] == doctest::Approx(4).epsilon(0.02));
}

TEST_CASE("a map of one pixel covers the photo")
{
    UltraHdrJpeg made;
    made.map_width = made.map_height = 1;
    CHECK(largest_difference(made) < 3e-6);
}

TEST_CASE("maps that cannot be applied say why")
{
    UltraHdrJpeg made;
    GainMapInfo info = info_of(made);
    info.metadata.base_is_hdr = true;
    CHECK(creation_error(info) == "its gain map leads from HDR to SDR: the base is HDR already");

    info = info_of(made);
    info.metadata.in_colors_of_base = false;
    CHECK(creation_error(info).empty()); // one factor for all channels
    info.metadata.max[1] = 3;
    CHECK(creation_error(info) ==
          "its gain map counts in other primaries than the photo's, which this program cannot apply");

    info.kind = GainMapInfo::Kind::apple;
    CHECK(creation_error(info) == "its gain map is of Apple's own kind, which this program cannot apply");
}

TEST_CASE("a map that is cut anywhere is an error")
{
    UltraHdrJpeg made;
    made.map_width = made.map_height = 40;
    GainMapInfo info = info_of(made);
    const std::string whole = info.jpeg;
    for (std::size_t size = 0; size < whole.size(); ++size) {
        info.jpeg = whole.substr(0, size);
        CHECK(creation_error(info).find("its gain map is damaged or truncated: ") == 0);
    }
}

TEST_CASE("a map of an absurd size is refused before memory is asked for")
{
    GainMapInfo info = info_of(UltraHdrJpeg());
    const std::size_t frame = info.jpeg.find("\xff\xc0");
    REQUIRE(frame != std::string::npos);
    info.jpeg.replace(frame + 5, 4, "\xff\x00\xff\x00", 4);
    CHECK(creation_error(info) == "its gain map has 65280 x 65280 pixels; the limit is 67108864");
    info.jpeg.replace(frame + 5, 4, "\x00\x00\x00\x00", 4);
    CHECK(creation_error(info).find("its gain map is damaged or truncated: ") == 0);
}
