// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_reader.h"

#include <fstream>
#include <utility>

#include <OpenImageIO/imagebuf.h>
#include <doctest/doctest.h>
#include <srisp/photo.h>
#include <srisp/thumbnail.h>

#include "image_compare.h"
#include "scratch_folder.h"

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

TEST_CASE("rows of bands that overlap are those of the whole, and each is read once")
{
    /// Rows of numbers; remembers what was asked of it.
    class Numbers : public PixelSource {
    public:
        std::optional<OIIO::ImageSpec> find_level(int, int) override { return OIIO::ImageSpec(); }
        Status read_rows(int, int, int y0, int y1, float* rows) override
        {
            if (y1 > 90)
                return Error{ "breaks off" };
            asked.emplace_back(y0, y1);
            for (int i = y0 * 6; i < y1 * 6; ++i)
                *rows++ = float(i) / 1000;
            return {};
        }
        const std::string& name() const override { return m_name; }
        const std::string& key() const override { return m_name; }
        std::vector<std::pair<int, int>> asked;

    private:
        std::string m_name = "numbers";
    };
    Numbers source;
    const OIIO::ImageSpec spec(2, 100, 3, OIIO::TypeUInt8);
    const auto converter = PhotoConverter::create(spec, InputEncoding::srgb, "numbers");
    REQUIRE(converter);
    PhotoReader reader(source, 0, 0, spec, *converter, 1);
    for (const auto& [y0, y1] : { std::pair(0, 40), std::pair(30, 70), std::pair(60, 90), std::pair(0, 10) }) {
        const auto rows = reader.rows(y0, y1);
        REQUIRE(rows);
        for (int i = 0; i < (y1 - y0) * 6; ++i)
            REQUIRE((*rows)->rgb[std::size_t(i)] == float(y0 * 6 + i) / 1000);
        CHECK((*rows)->counts(y0 + 1, y1).values == (y1 - y0 - 1) * 6);
    }
    CHECK(source.asked == std::vector<std::pair<int, int>>{ { 0, 40 }, { 40, 70 }, { 70, 90 }, { 0, 10 } });
    const auto broken = reader.rows(80, 100);
    REQUIRE(!broken);
    CHECK(broken.error().message == "breaks off");
}

TEST_CASE("a photo that breaks off is an error, and taken as far as it goes where that is allowed")
{
    const ScratchFolder folder;
    std::ifstream whole(std::string(SRISP_SOURCE_DIR) + "/configs/sample/photo.jpg", std::ios::binary);
    std::string bytes(12000, '\0');
    REQUIRE(whole.read(bytes.data(), std::streamsize(bytes.size())));
    const std::string path = folder.path("half.jpg");
    std::ofstream(path, std::ios::binary) << bytes;

    const auto thumbnail = load_photo_thumbnail(path);
    REQUIRE(!thumbnail);
    CHECK(thumbnail.error().message.find("photo '" + path + "': damaged or truncated at row ") == 0);

    Options options;
    options.allow_partial = true;
    const auto source = open_file_source(path, "photo", reading_hints(options));
    REQUIRE(source);
    const auto spec = (*source)->find_level(0, 0);
    REQUIRE(spec);
    std::vector<float> rows(std::size_t(spec->width) * spec->height * spec->nchannels);
    CHECK((*source)->read_rows(0, 0, 0, spec->height, rows.data()));
    CHECK((*source)->notes().size() == 1);
}
