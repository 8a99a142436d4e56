// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_reader.h"

#include <OpenImageIO/imagebuf.h>
#include <doctest/doctest.h>
#include <srisp/photo.h>
#include <srisp/thumbnail.h>

#include "image_compare.h"
#include "random_model.h"

using namespace srisp;

TEST_CASE("the thumbnail of a file is that of its pixels, upright")
{
    const std::string path = std::string(SRISP_SOURCE_DIR) + "/configs/sample/photo.jpg";
    OIIO::ImageBuf photo(path);
    const OIIO::ImageSpec& spec = photo.spec();
    std::vector<float> rgb(std::size_t(3) * spec.width * spec.height);
    REQUIRE(photo.get_pixels(OIIO::ROI(0, spec.width, 0, spec.height, 0, 1, 0, 3), OIIO::TypeFloat, rgb.data()));
    const ScratchFolder folder;
    for (const int orientation : { 1, 6 }) {
        OIIO::ImageBuf turned(photo);
        turned.specmod()["Orientation"] = orientation;
        REQUIRE(turned.write(folder.path("turned.tif"), OIIO::TypeUInt8));
        const auto thumbnail = load_photo_thumbnail(folder.path("turned.tif"));
        REQUIRE_MESSAGE(thumbnail, (thumbnail ? "" : thumbnail.error().message));
        const ImageView view{ rgb.data(), spec.width, spec.height, 3, std::ptrdiff_t(3) * spec.width };
        const Difference difference = compare(thumbnail->rgb, make_thumbnail(view, orientation).rgb);
        INFO(difference.text);
        CHECK(difference.largest <= 1e-6);
    }
}

TEST_CASE("what is no photo is named")
{
    const auto thumbnail = load_photo_thumbnail("missing.jpg");
    REQUIRE(!thumbnail);
    CHECK(thumbnail.error().message == "photo 'missing.jpg': does not exist");
}
