// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbake/bake_choice.h"

#include <doctest/doctest.h>

#include <OpenImageIO/imagebuf.h>

#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// Red is x, green is y, both over 1000.
std::string image(const ScratchFolder& folder, int width, int height)
{
    OIIO::ImageBuf picture(OIIO::ImageSpec(width, height, 3, OIIO::TypeFloat));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float rgb[] = { float(x) / 1000, float(y) / 1000, 0 };
            picture.setpixel(x, y, rgb);
        }
    picture.specmod()["oiio:ColorSpace"] = "sRGB";
    const std::string path = folder.path("picture.tif");
    REQUIRE(picture.write(path));
    return path;
}

} // namespace

TEST_CASE("the parts of a photo are its pixels")
{
    const ScratchFolder folder;
    const PhotoSample sample = read_photo_sample(image(folder, 900, 700));
    REQUIRE(sample.tiles.size() == 16);
    for (const PhotoSample::Tile& tile : sample.tiles) {
        CHECK(tile.roi.x1 - tile.roi.x0 == 96);
        CHECK(tile.roi.y1 - tile.roi.y0 == 96);
        REQUIRE(tile.rgb.size() == std::size_t(3) * 96 * 96);
        for (const int y : { 0, 50, 95 })
            for (const int x : { 0, 60, 95 }) {
                const float* rgb = &tile.rgb[std::size_t(3) * (y * 96 + x)];
                CHECK(rgb[0] == doctest::Approx(float(tile.roi.x0 + x) / 1000));
                CHECK(rgb[1] == doctest::Approx(float(tile.roi.y0 + y) / 1000));
            }
    }
}

TEST_CASE("of a small photo all pixels are taken, once")
{
    const ScratchFolder folder;
    for (const auto& [width, height] : { std::pair(300, 17), std::pair(1, 1), std::pair(2, 383) }) {
        int pixels = 0;
        for (const PhotoSample::Tile& tile : read_photo_sample(image(folder, width, height)).tiles)
            pixels += (tile.roi.x1 - tile.roi.x0) * (tile.roi.y1 - tile.roi.y0);
        CHECK(pixels == width * height);
    }
}

TEST_CASE("a photo that is none is named")
{
    CHECK(failure_of([] { read_photo_sample("no.jpg"); }) == "1: photo 'no.jpg': does not exist");
}
