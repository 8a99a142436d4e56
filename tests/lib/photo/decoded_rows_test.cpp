// SPDX-License-Identifier: Apache-2.0
#include "photo/decoded_rows.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <OpenImageIO/imagebuf.h>
#include <doctest/doctest.h>

#include "photo/pixel_source.h"
#include "scratch_folder.h"

using namespace srisp;

TEST_CASE("rows are found by their key once, as long as somebody keeps them")
{
    auto rows = DecodedRows::create(4, 10);
    REQUIRE(rows);
    rows->row(9)[3] = 5;
    CHECK(!DecodedRows::take("a"));
    DecodedRows::offer("a", rows);
    CHECK(!DecodedRows::take("b"));
    CHECK(DecodedRows::take("a") == rows);
    CHECK(!DecodedRows::take("a"));
    CHECK(rows->row(9)[3] == 5);

    DecodedRows::offer("a", rows);
    rows.reset();
    CHECK(!DecodedRows::take("a"));
}

TEST_CASE("rows that were read are forgotten")
{
    const auto rows = DecodedRows::create(4, 10);
    REQUIRE(rows);
    CHECK(rows->holds(0));
    rows->forget_before(3);
    CHECK(!rows->holds(2));
    CHECK(rows->holds(3));
}

TEST_CASE("all that is kept at a time has a limit")
{
    constexpr std::size_t row = std::size_t(32) << 20;
    std::vector<std::shared_ptr<DecodedRows>> all;
    while (all.size() < 100)
        if (auto rows = DecodedRows::create(row, 1))
            all.push_back(rows);
        else
            break;
    CHECK(all.size() == 10);
    all.back()->forget_before(1);
    CHECK(DecodedRows::create(row, 1));
    all.pop_back();
    CHECK(DecodedRows::create(row, 1)); // what it forgot does not count twice
    CHECK(!DecodedRows::create(row * 100, 1));
}

namespace {

std::vector<float> all_rows(PixelSource& source, int rows_at_once)
{
    const auto spec = source.find_level(0, 0);
    REQUIRE(spec);
    const std::size_t row = std::size_t(spec->width) * std::size_t(spec->nchannels);
    std::vector<float> values(row * std::size_t(spec->height));
    for (int y = 0; y < spec->height; y += rows_at_once) {
        const auto read = source.read_rows(0, 0, y, std::min(y + rows_at_once, spec->height), values.data() + row * y);
        REQUIRE_MESSAGE(read, (read ? "" : read.error().message));
    }
    return values;
}

std::unique_ptr<PixelSource> opened(const std::string& path)
{
    auto source = open_file_source(path, "photo");
    REQUIRE(source);
    return std::move(*source);
}

} // namespace

TEST_CASE("what one reader decoded for a thumbnail, the next one does not decode again, whatever the file holds")
{
    OIIO::ImageBuf photo(std::string(SRISP_SOURCE_DIR) + "/configs/sample/photo.jpg");
    const ScratchFolder folder;
    OIIO::ImageBuf tiled = photo;
    tiled.set_write_tiles(64, 32);
    REQUIRE(photo.write(folder.path("a.jpg")));
    // No PNG: OpenImageIO 2.4's reader leaks its message where such a file breaks off.
    REQUIRE(photo.write(folder.path("b.tif"), OIIO::TypeUInt16));
    REQUIRE(tiled.write(folder.path("c.tif"), OIIO::TypeUInt16));
    for (const char* name : { "a.jpg", "b.tif", "c.tif" }) {
        CAPTURE(name);
        const std::string path = folder.path(name);
        const std::vector<float> expected = all_rows(*opened(path), 1000);
        const auto first = opened(path), second = opened(path);
        first->expect_second_pass(0);
        CHECK(all_rows(*first, 7) == expected);
        std::filesystem::resize_file(path, 2000); // nothing is left to decode
        CHECK(all_rows(*second, 11) == expected);
        std::vector<float> row(expected.size());
        CHECK(!second->read_rows(0, 0, 0, 200, row.data())); // it was forgotten
    }
}

TEST_CASE("a reader may go back, which decodes again")
{
    const std::string path = std::string(SRISP_SOURCE_DIR) + "/configs/sample/photo.jpg";
    const std::vector<float> expected = all_rows(*opened(path), 1000);
    const auto source = opened(path);
    source->expect_second_pass(0);
    for (int pass = 0; pass < 3; ++pass)
        CHECK(all_rows(*source, 10) == expected);
    // Floats are OpenImageIO's to decode.
    const ScratchFolder folder;
    OIIO::ImageBuf photo(path);
    REQUIRE(photo.write(folder.path("a.exr"), OIIO::TypeHalf));
    const auto floats = opened(folder.path("a.exr"));
    floats->expect_second_pass(0);
    const std::vector<float> once = all_rows(*floats, 10);
    CHECK(all_rows(*floats, 13) == once);
}
