// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisppack/crops.h"

#include <string>

#include <doctest/doctest.h>

#include "thumbnail/area_squasher.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("crops are half to all of a photo, inside it, and never smaller than what they are squashed to")
{
    const std::pair<int, int> sizes[] = { { 400, 267 }, { 267, 400 }, { 143, 1000 }, { 5000, 4000 }, { 256, 256 } };
    for (const auto& [width, height] : sizes)
        for (int photo = 0; photo < 100; ++photo) {
            const std::vector<Roi> crops = choose_crops(width, height, 128, 3, 1, std::to_string(photo));
            REQUIRE(crops.size() == 4);
            CHECK((crops[0].x0 == 0 && crops[0].x1 == width && crops[0].y0 == 0 && crops[0].y1 == height));
            for (const Roi& crop : crops) {
                const int w = crop.x1 - crop.x0, h = crop.y1 - crop.y0;
                CHECK((crop.x0 >= 0 && crop.y0 >= 0 && crop.x1 <= width && crop.y1 <= height));
                CHECK((w >= 128 && h >= 128 && 2 * w >= width - 1 && 2 * h >= height - 1));
            }
        }
}

TEST_CASE("photos that are hardly larger than the pack's size have no crops but the whole")
{
    CHECK(choose_crops(400, 130, 128, 3, 0, "a").size() == 1);
    CHECK(choose_crops(400, 40, 128, 3, 0, "a").size() == 1);
    CHECK(choose_crops(400, 143, 128, 3, 0, "a").size() == 4);
}

TEST_CASE("crops depend on name and seed alone, and differ between them")
{
    const auto first = [](std::uint64_t seed, const char* name) {
        const Roi crop = choose_crops(4000, 3000, 64, 1, seed, name)[1];
        return std::vector<int>{ crop.x0, crop.x1, crop.y0, crop.y1 };
    };
    CHECK(first(0, "a.jpg") == first(0, "a.jpg"));
    CHECK(first(0, "a.jpg") != first(0, "b.jpg"));
    CHECK(first(0, "a.jpg") != first(1, "a.jpg"));
}

TEST_CASE("a crop of the upright photo is cut from where it is stored, for every orientation")
{
    const int size = 4; // one value per pixel of the upright image
    const Roi upright{ 1, 3, 0, 3 };
    for (int orientation = 1; orientation <= 8; ++orientation) {
        // Stored pixels are numbered, and turned upright to know where each should be.
        std::vector<float> stored;
        for (int i = 0; i < size * size; ++i)
            stored.insert(stored.end(), 3, float(i));
        const std::vector<float> turned = oriented_square(stored, size, orientation);
        const Roi cut = stored_crop(upright, size, size, orientation);
        double expected = 0, found = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const std::size_t at = std::size_t(y * size + x) * 3;
                // Powers of two: the sum tells which pixels are in it.
                if (x >= upright.x0 && x < upright.x1 && y >= upright.y0 && y < upright.y1)
                    expected += double(1 << int(turned[at]));
                if (x >= cut.x0 && x < cut.x1 && y >= cut.y0 && y < cut.y1)
                    found += double(1 << int(stored[at]));
            }
        CHECK_MESSAGE(expected == found, "orientation ", orientation);
    }
}

TEST_CASE("values become 16 bits, channel after channel, clipped")
{
    std::vector<std::uint16_t> pixels;
    append_pixels({ 0, 0.5f, 1, 2, -1, 1e-5f }, pixels);
    CHECK(pixels == std::vector<std::uint16_t>{ 0, 65535, 32768, 0, 65535, 1 });
}

namespace {

constexpr int kWidth = 12, kHeight = 10;

/// The part that is left of an image of ones with these pixels zero, as "x0 x1 y0 y1".
std::string part_without(const std::vector<Roi>& zeros)
{
    std::vector<float> rgb(kWidth * kHeight * 3, 1.0f);
    for (const Roi& zero : zeros)
        for (int y = zero.y0; y < zero.y1; ++y)
            for (int i = zero.x0 * 3; i < zero.x1 * 3; ++i)
                rgb[std::size_t(y * kWidth * 3 + i)] = 0;
    const Roi part = largest_unmasked_part(rgb, kWidth, kHeight);
    return std::to_string(part.x0) + " " + std::to_string(part.x1) + " " + std::to_string(part.y0) + " " +
           std::to_string(part.y1);
}

} // namespace

TEST_CASE("an image without masks is taken whole, dark pixels or not")
{
    CHECK(part_without({}) == "0 12 0 10");
    CHECK(part_without({ { 3, 4, 3, 4 }, { 7, 9, 0, 10 } }) == "0 12 0 10");
}

TEST_CASE("the largest rectangle beside a masked one is taken")
{
    CHECK(part_without({ { 9, 12, 6, 10 } }) == "0 9 0 10");
    CHECK(part_without({ { 0, 12, 0, 3 } }) == "0 12 3 10");
    CHECK(part_without({ { 4, 7, 2, 5 } }) == "0 12 5 10");
    CHECK(part_without({ { 0, 12, 0, 10 } }) == "0 0 0 0");
}
