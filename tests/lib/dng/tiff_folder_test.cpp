// SPDX-License-Identifier: Apache-2.0
#include "dng/tiff_folder.h"

#include <cmath>

#include <doctest/doctest.h>

#include "raw_file/tiff_tags.h"

using namespace srisp;

TEST_CASE("Fractions are the float that they stand for")
{
    CHECK(fraction_of(0) == std::pair<std::int32_t, std::int32_t>(0, 1));
    CHECK(fraction_of(0.5f) == std::pair<std::int32_t, std::int32_t>(1, 2));
    CHECK(fraction_of(-0.7034f) == std::pair<std::int32_t, std::int32_t>(-3517, 5000));
    CHECK(fraction_of(1.0f / 8000) == std::pair<std::int32_t, std::int32_t>(1, 8000));
    CHECK(fraction_of(65535) == std::pair<std::int32_t, std::int32_t>(65535, 1));
    for (float value = 1e-4f; value < 1e8f; value *= 1.37f) {
        const auto [numerator, denominator] = fraction_of(value);
        CHECK(float(double(numerator) / denominator) == value);
    }
    CHECK(fraction_of(INFINITY).second == 1);
    CHECK(fraction_of(1e-30f).second > 0);
}

TEST_CASE("A folder is read as it was set, its tags sorted, its values at even offsets")
{
    TiffFolderBytes folder;
    folder.set_longs(330, { 70000 });
    folder.set_text(270, std::string("odd\0cut", 7));
    folder.set_text(271, "eight by");
    folder.set_shorts(258, { 8, 9, 10 });
    folder.set_doubles(51041, { 1e-9, 0.25 });
    folder.set_signed_rationals(50721, { -0.5f, 2 });
    folder.set_bytes(700, "<xmp>");
    const std::string file = tiff_header() + folder.bytes(8);
    CHECK(file.size() == 8 + folder.size());
    CHECK(folder.size() % 2 == 0);

    const TiffTags tags(reinterpret_cast<const unsigned char*>(file.data()), file.size());
    REQUIRE(tags.folders().size() >= 1);
    const TiffFolder& read = tags.folders()[0];
    CHECK(read.tags.size() == 7);
    for (std::size_t i = 0; i < read.tags.size(); ++i) {
        CHECK((i == 0 || read.tags[i - 1].tag < read.tags[i].tag));
        CHECK(read.tags[i].offset % 2 == 0);
    }
    CHECK(tags.value(read, 330, 0) == 70000);
    CHECK(tags.text(read, 270) == "odd");
    CHECK(tags.text(read, 271) == "eight by");
    CHECK(tags.values(read, 258) == std::vector<double>{ 8, 9, 10 });
    CHECK(tags.values(read, 51041) == std::vector<double>{ 1e-9, 0.25 });
    CHECK(tags.values(read, 50721) == std::vector<double>{ -0.5, 2 });
    CHECK(tags.bytes(read, 700) == "<xmp>");
}
