// SPDX-License-Identifier: Apache-2.0
#include <srisp/srisp.h>

#include <algorithm>
#include <cmath>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

const std::string kSample = std::string(SRISP_SOURCE_DIR) + "/configs/sample/";
const std::string kReference = kSample + "reference.dng";

Image made(const std::string& photo, const std::string& resize, const std::string& crop, std::uint64_t seed = 0)
{
    Options options;
    options.resize = resize;
    options.crop = crop;
    options.seed = seed;
    auto image = unprocess(photo, kReference, options);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return std::move(*image);
}

/// What is made of a photo that was resized and cropped before, and stored as 16 bits.
Image made_of_file(const OIIO::ImageBuf& photo, int orientation)
{
    const ScratchFolder folder;
    OIIO::ImageBuf described = photo;
    described.specmod().attribute("oiio:ColorSpace", "sRGB");
    described.specmod().attribute("Orientation", orientation);
    REQUIRE(described.write(folder.path("photo.tif"), OIIO::TypeUInt16));
    return made(folder.path("photo.tif"), "", "");
}

double largest_difference(const Image& a, const Image& b)
{
    REQUIRE(a.pixels().size() == b.pixels().size());
    double most = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        most = std::max(most, double(std::abs(a.pixels()[i] - b.pixels()[i])));
    return most;
}

} // namespace

TEST_CASE("a photo that is resized and cropped is one that was so before, turned or not")
{
    const ScratchFolder folder;
    for (const int orientation : { 1, 6 }) {
        CAPTURE(orientation);
        OIIO::ImageBuf photo(kSample + "photo.jpg");
        photo.read(0, 0, true, OIIO::TypeFloat);
        const int width = photo.spec().width / 4, height = photo.spec().height / 4;
        const OIIO::ImageBuf small = OIIO::ImageBufAlgo::resize(photo, "", 0.0f, { 0, width, 0, height, 0, 1, 0, 3 });
        const OIIO::ROI middle{
            (width - 60) / 2, (width - 60) / 2 + 60, (height - 40) / 2, (height - 40) / 2 + 40, 0, 1, 0, 3
        };
        const Image expected = made_of_file(OIIO::ImageBufAlgo::cut(small, middle), orientation);
        photo.specmod().attribute("Orientation", orientation);
        REQUIRE(photo.write(folder.path("whole.tif"), OIIO::TypeUInt8));
        const auto upright = [&](int across, int down) {
            const bool turned = orientation == 6;
            return std::to_string(turned ? down : across) + "x" + std::to_string(turned ? across : down);
        };
        const Image image = made(folder.path("whole.tif"), upright(width, height), upright(60, 40));
        CHECK(image.spec().width == 60);
        CHECK(image.spec().height == 40);
        CHECK(largest_difference(image, expected) < 2e-4);
    }
}

TEST_CASE("a random crop depends on the seed")
{
    const Image a = made(kSample + "photo.jpg", "", "random:64", 1);
    CHECK(a.pixels() == made(kSample + "photo.jpg", "", "random:64", 1).pixels());
    CHECK(a.pixels() != made(kSample + "photo.jpg", "", "random:64", 2).pixels());
}

TEST_CASE("a crop that does not fit is refused")
{
    Options options;
    options.crop = "9000";
    const auto image = unprocess(kSample + "photo.jpg", kReference, options);
    REQUIRE(!image);
    CHECK(image.error().message.find("photo.jpg': crop '9000': the photo has only") != std::string::npos);
}
