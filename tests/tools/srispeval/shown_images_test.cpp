// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispeval/shown_images.h"

#include <doctest/doctest.h>

#include <set>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "../../../tools/srispeval/picture_files.h"
#include "base/random.h"
#include "some_scores.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("a report shows the worst first, and where not all fit others from all over")
{
    Evaluation evaluation;
    evaluation.methods = { "first", "second" };
    for (int i = 0; i < 100; ++i)
        evaluation.images.push_back(some_score(std::to_string(i), "X", 50, 20 + (i * 37) % 100));
    const auto all = shown_images(evaluation, 100), some = shown_images(evaluation, 30);
    CHECK(all.size() == 100);
    CHECK(evaluation.images[all[0]].methods.at("second").values.at(key::kPsnr).sum == 20);
    REQUIRE(some.size() == 30);
    CHECK(std::vector<std::size_t>(some.begin(), some.begin() + 10) ==
          std::vector<std::size_t>(all.begin(), all.begin() + 10));
    CHECK(std::set<std::size_t>(some.begin(), some.end()).size() == 30);
    CHECK(evaluation.images[some.back()].methods.at("second").values.at(key::kPsnr).sum > 110);
    CHECK(shown_images(evaluation, 0).empty());
}

TEST_CASE("pictures are as large as the report may be")
{
    CHECK(picture_side(3, 3, 3, 18) == 320);
    CHECK(picture_side(100000, 100, 3, 18) == 64);
    const double side = picture_side(100, 100, 3, 18), bytes = side * side * 0.75 * (3.8 * 5 + 0.5) * 4 / 3;
    CHECK(100 * bytes < 18e6);
    CHECK(100 * bytes > 16e6);
    CHECK(picture_side(100, 100, 6, 18) < side);
}

TEST_CASE("linear pictures hold 16 bits, of which nine are kept")
{
    Pixels pixels(16, 8);
    Random random(1);
    for (float& value : pixels.rgb)
        value = float(random.log_uniform(1e-5, 1.1));
    pixels.rgb[0] = 1;
    pixels.rgb[1] = 0;
    const auto file = png_of_linear(pixels);
    REQUIRE(file);
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(file->data()), file->size());
    const auto input = OIIO::ImageInput::open("a.png", nullptr, &memory);
    REQUIRE(input);
    CHECK(input->spec().width == 16);
    REQUIRE(input->spec().height == 16);
    REQUIRE(input->spec().nchannels == 3);
    std::vector<unsigned char> bytes(16 * 16 * 3);
    REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, bytes.data()));
    for (std::size_t i = 0; i < pixels.rgb.size(); ++i) {
        const double stored = bytes[i] * 256 + bytes[pixels.rgb.size() + i];
        const double wanted = std::min(pixels.rgb[i], 1.0f) * 65535;
        CHECK(std::abs(stored - wanted) <= 0.51 + wanted / 512);
    }
    CHECK(bytes[0] * 256 + bytes[pixels.rgb.size()] == 65535);
}
