// SPDX-License-Identifier: Apache-2.0
// Subimages, MIP levels, tiles, single rows, several threads: all the same pixels.
#include <thread>

#include <OpenImageIO/imagebufalgo.h>
#include <srisp/metadata.h>

#include "test_images.h"

using namespace srisp;
using namespace srisp::plugin;

namespace {

std::string query(const std::string& photo, const std::string& reference)
{
    return photo + ".srisp?reference=" + reference;
}

/// Two subimages of different sizes.
std::string write_two(const ScratchFolder& folder)
{
    const std::string path = folder.path("two.exr");
    std::vector<OIIO::ImageSpec> specs = { OIIO::ImageSpec(50, 40, 3, OIIO::TypeFloat),
                                           OIIO::ImageSpec(30, 60, 3, OIIO::TypeFloat) };
    for (OIIO::ImageSpec& spec : specs) // a multi-part EXR has one display window
        spec.full_width = spec.full_height = 64;
    specs[0].attribute("oiio:subimagename", "left");
    specs[1].attribute("oiio:subimagename", "right");
    auto output = OIIO::ImageOutput::create(path);
    REQUIRE_MESSAGE(output->open(path, 2, specs.data()), output->geterror());
    REQUIRE(output->write_image(OIIO::TypeFloat, test_pixels(50, 40, 3).data()));
    REQUIRE(output->open(path, specs[1], OIIO::ImageOutput::AppendSubimage));
    REQUIRE(output->write_image(OIIO::TypeFloat, test_pixels(30, 60, 3, 0.0f, 0.2f).data()));
    REQUIRE(output->close());
    return path;
}

/// Tiled and MIP-mapped.
std::string write_texture(const ScratchFolder& folder)
{
    const std::string path = folder.path("texture.tx");
    const auto pixels = test_pixels(150, 110, 3);
    OIIO::ImageSpec spec(150, 110, 3, OIIO::TypeFloat);
    OIIO::ImageBuf image(spec);
    image.set_pixels(OIIO::ROI::All(), OIIO::TypeFloat, pixels.data());
    OIIO::ImageSpec config;
    config.tile_width = config.tile_height = 32;
    config.attribute("maketx:fileformatname", "openexr");
    REQUIRE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, path, config));
    return path;
}

} // namespace

TEST_CASE("each subimage has its own parameters")
{
    const ScratchFolder folder;
    SrispInput input;
    open_ours(input, query(write_two(folder), write_reference(folder)));
    const OIIO::ImageSpec first = input.spec(0, 0), second = input.spec(1, 0);
    CHECK(second.width == 30);
    CHECK(second.get_string_attribute("oiio:subimagename") == "right");
    CHECK(to_json(*recorded_parameters(first, "0")) != to_json(*recorded_parameters(second, "1")));
    CHECK(read_all(input, 1).size() == 30u * 60 * 3);
    CHECK(read_all(input, 0).size() == 50u * 40 * 3);
    CHECK(!input.seek_subimage(2, 0));
    CHECK(!input.has_error());
}

TEST_CASE("MIP levels take the parameters of the largest")
{
    const ScratchFolder folder;
    SrispInput input;
    open_ours(input, query(write_texture(folder), write_reference(folder)));
    const std::string largest = to_json(*recorded_parameters(input.spec(0, 0), "0"));
    int levels = 1;
    for (; input.seek_subimage(0, levels); ++levels) {
        CHECK(to_json(*recorded_parameters(input.spec(0, levels), "level")) == largest);
        CHECK(read_all(input, 0, levels).size() ==
              std::size_t(input.spec(0, levels).width) * input.spec(0, levels).height * 3);
    }
    CHECK(levels > 5);
}

TEST_CASE("tiles hold the same pixels as the whole")
{
    const ScratchFolder folder;
    SrispInput input;
    const OIIO::ImageSpec spec = open_ours(input, query(write_texture(folder), write_reference(folder)));
    REQUIRE(spec.tile_width == 32);
    const auto whole = read_all(input);
    SrispInput other;
    open_ours(other, query(folder.path("texture.tx"), folder.path("reference.exr")));
    std::vector<float> tile(32 * 32 * 3);
    // From the last to the first, which no reader likes.
    for (int ty = 96; ty >= 0; ty -= 32)
        for (int tx = 128; tx >= 0; tx -= 32) {
            REQUIRE(other.read_tile(tx, ty, 0, OIIO::TypeFloat, tile.data()));
            for (int y = 0; y < std::min(32, spec.height - ty); ++y)
                for (int x = 0; x < std::min(32, spec.width - tx) * 3; ++x)
                    REQUIRE(tile[y * 96 + x] == whole[((ty + y) * spec.width + tx) * 3 + x]);
        }
}

TEST_CASE("rows from the last to the first are those of the whole")
{
    const ScratchFolder folder;
    const std::string name = query(write_photo(folder, "p.jpg", 60, 600), write_reference(folder));
    SrispInput input, other;
    open_ours(input, name);
    const auto whole = read_all(input);
    open_ours(other, name);
    std::vector<float> row(60 * 3);
    for (int y = 599; y >= 0; --y) {
        REQUIRE(other.read_scanline(y, 0, OIIO::TypeFloat, row.data()));
        REQUIRE(std::equal(row.begin(), row.end(), whole.begin() + y * 180));
    }
}

TEST_CASE("many threads may read one input, each gets its rows")
{
    const ScratchFolder folder;
    const std::string name = query(write_photo(folder, "p.png", 60, 900), write_reference(folder));
    SrispInput input, shared;
    open_ours(input, name);
    const auto whole = read_all(input);
    open_ours(shared, name);
    std::vector<std::vector<float>> parts(6, std::vector<float>(60 * 150 * 3));
    std::vector<std::thread> threads;
    for (int i = 0; i < 6; ++i)
        threads.emplace_back(
            [&, i] { shared.read_scanlines(0, 0, i * 150, (i + 1) * 150, 0, 0, 3, OIIO::TypeFloat, parts[i].data()); });
    for (auto& thread : threads)
        thread.join();
    for (int i = 0; i < 6; ++i)
        CHECK(std::equal(parts[i].begin(), parts[i].end(), whole.begin() + i * 150 * 180));
}

TEST_CASE("one thread gives the same bits as all")
{
    const ScratchFolder folder;
    const std::string name = query(write_photo(folder, "p.png", 200, 300), write_reference(folder));
    SrispInput all, one;
    open_ours(all, name);
    one.threads(1);
    open_ours(one, name);
    CHECK(read_all(all) == read_all(one));
}
