// SPDX-License-Identifier: Apache-2.0
// What is written is what the readers of references read.
#include <srisp/dng.h>

#include <srisp/reference.h>

#include "base/half_float.h"
#include "lib/dng/made_dng.h"
#include "shared_files.h"

using namespace srisp;

namespace {

const char* const kPhases[] = { "RGGB", "GRBG", "GBRG", "BGGR" };

void check_same(const ScratchFolder& folder, const DngImage& image, const DngOptions& options)
{
    CAPTURE(image.width);
    CAPTURE(image.height);
    CAPTURE(image.planes);
    CAPTURE(options.bits);
    CAPTURE(int(options.compression));
    CAPTURE(int(options.layout));
    written(folder.path("a.dng"), image, options);
    const RawImage raw = decoded(folder.path("a.dng"));
    CHECK(different_samples(raw.pixels, image) == 0);
    CHECK(raw.facts.cfa_pattern == image.cfa_pattern);
    CHECK(raw.notes.empty());
}

} // namespace

TEST_CASE("Mosaics and LinearRaw are read as written: each size, compression, number of bits and layout")
{
    const ScratchFolder folder;
    for (const int planes : { 1, 3 })
        for (const auto& [width, height] :
             { std::pair(22, 22), std::pair(67, 35), std::pair(45, 600), std::pair(1030, 517) })
            for (const int bits : { 10, 11, 12, 13, 14, 15, 16 })
                for (const auto compression : { DngCompression::none, DngCompression::lossless })
                    for (const auto layout : { DngLayout::standard, DngLayout::cinema }) {
                        if (height > 500 && bits % 4 != 0)
                            continue;
                        MadeImage made(width, height, planes, bits);
                        made.with_preview(2, 1);
                        check_same(folder, made.image, { compression, bits, layout, 0 });
                    }
}

TEST_CASE("Widths that dcraw's relatives could take for others are read as written")
{
    const ScratchFolder folder;
    for (const int width : { 31, 32, 33, 48, 63, 64, 96, 512, 513, 544, 1024, 1040 })
        for (const int height : { 22, 32, 33, 530 })
            for (const auto layout : { DngLayout::standard, DngLayout::cinema }) {
                MadeImage made(width, height, 1);
                check_same(folder, made.image, { DngCompression::lossless, 16, layout, 0 });
            }
}

TEST_CASE("All four phases are read as written")
{
    const ScratchFolder folder;
    for (const char* phase : kPhases) {
        MadeImage made(67, 36, 1);
        made.image.cfa_pattern = phase;
        check_same(folder, made.image, {});
    }
}

TEST_CASE("Rows further apart than the image is wide are read as written")
{
    const ScratchFolder folder;
    for (const auto compression : { DngCompression::none, DngCompression::lossless }) {
        MadeImage made(67, 36, 1);
        made.image.width = 50;
        check_same(folder, made.image, { compression, 16, DngLayout::standard, 0 });
    }
}

TEST_CASE("Floats are read as written")
{
    const ScratchFolder folder;
    for (const int bits : { 16, 32 })
        for (const auto compression : { DngCompression::none, DngCompression::deflate })
            for (const auto& [width, height] : { std::pair(2, 2), std::pair(67, 35), std::pair(600, 517) }) {
                MadeImage made(width, height, 3);
                made.as_floats();
                for (std::size_t i = 0; bits == 16 && i < std::size_t(width) * std::size_t(height) * 3; ++i)
                    made.float_sample(i) = float_from_half(half_from_float(made.float_sample(i)));
                check_same(folder, made.image, { compression, bits, DngLayout::standard, 0 });
            }
}

TEST_CASE("Floats of 32 bits become the nearest ones of 16")
{
    const ScratchFolder folder;
    MadeImage made(4, 4, 3);
    made.as_floats();
    written(folder.path("a.dng"), made.image, { DngCompression::deflate, 16, DngLayout::standard, 0 });
    const RawImage raw = decoded(folder.path("a.dng"));
    for (std::size_t i = 0; i < 48; ++i)
        CHECK(raw.pixels.floats[i] == float_from_half(half_from_float(made.float_sample(i))));
}

TEST_CASE("Levels, matrices, neutral, orientation, exposure and noise are read as written")
{
    const ScratchFolder folder;
    for (const auto layout : { DngLayout::standard, DngLayout::cinema }) {
        MadeImage made(64, 48, 1, 12);
        made.with_preview(16, 12);
        DngImage& image = made.image;
        image.black_rows = image.black_columns = 2;
        image.black = { 64, 100.5f, 30.25f, 80 };
        image.white = { 4000, 0, 0 };
        image.facts.noise_profile = { 1e-4, 2.5e-7 };
        written(folder.path("a.dng"), image, { DngCompression::lossless, 12, layout, 0 });
        const auto reference = load_reference(folder.path("a.dng"));
        REQUIRE(reference);
        const CameraFacts& facts = (*reference)->facts;
        CHECK(facts.make == "Maker");
        CHECK(facts.model == "Model 5");
        CHECK(facts.orientation == 6);
        CHECK(facts.width == 64);
        CHECK(facts.height == 48);
        CHECK(facts.black_level == std::array<float, 4>{ 64, 100.5f, 80, 30.25f });
        CHECK(facts.white_level == 4000);
        REQUIRE(facts.color_matrices.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(facts.color_matrices[i].illuminant == image.facts.color_matrices[i].illuminant);
            CHECK(facts.color_matrices[i].xyz_to_camera == image.facts.color_matrices[i].xyz_to_camera);
        }
        CHECK(facts.as_shot_neutral == image.facts.as_shot_neutral);
        CHECK(facts.iso == 400);
        CHECK(facts.exposure_time_s == image.facts.exposure_time_s);
        CHECK(facts.f_number == image.facts.f_number);
        CHECK(facts.noise_profile == image.facts.noise_profile);
        CHECK((*reference)->notes.empty());
    }
}

TEST_CASE("Three planes have levels of their own")
{
    const ScratchFolder folder;
    MadeImage made(30, 22, 3);
    made.image.black = { 1, 2, 3 };
    made.image.white = { 60000, 61000, 62000 };
    written(folder.path("a.dng"), made.image);
    const RawImage raw = decoded(folder.path("a.dng"));
    CHECK(raw.pixels.white == std::array<float, 3>{ 60000, 61000, 62000 });
    CHECK(raw.pixels.black.pattern == std::vector<float>{ 1, 2, 3 });
}

TEST_CASE("The bytes are the same for any number of threads")
{
    const ScratchFolder folder;
    MadeImage made(1100, 1100, 1);
    written(folder.path("one.dng"), made.image, { DngCompression::lossless, 16, DngLayout::standard, 1 });
    written(folder.path("more.dng"), made.image, { DngCompression::lossless, 16, DngLayout::standard, 3 });
    const FileBytes one = read_file(folder.path("one.dng")), more = read_file(folder.path("more.dng"));
    CHECK(std::string(one.data.get(), one.data.get() + one.size) ==
          std::string(more.data.get(), more.data.get() + more.size));
}

TEST_CASE("A pipe gets the same bytes as a file")
{
    const ScratchFolder folder;
    const std::string pipe = folder.path("pipe.dng"), copy = folder.path("copy.dng");
    REQUIRE(output_of("mkfifo '" + pipe + "'").empty());
    MadeImage made(300, 200, 1);
    made.with_preview(30, 20);
    FILE* reader = popen(("timeout 60 cat '" + pipe + "' >'" + copy + "'").c_str(), "r");
    written(pipe, made.image);
    pclose(reader);
    CHECK(different_samples(decoded(copy).pixels, made.image) == 0);
}

TEST_CASE("Real RAW files are read as they were once they are written as DNGs")
{
    SKIP_WITHOUT_SHARED("data/raw");
    const ScratchFolder folder;
    for (const char* name :
         { "blackmagic_pocket.dng", "canon_eos_d30.crw", "canon_powershot_s40.crw", "gopro_hero6.dng", "nikon_d1.nef",
           "pi_640x480.dng", "raspberry_pi.dng", "google_pixel7_dark.dng" }) {
        CAPTURE(std::string(name));
        const RawImage real = decoded(shared_file("data/raw/" + std::string(name)));
        if (!real.pixels.black.by_column.empty() || !real.pixels.black.by_row.empty() || real.pixels.cfa.rows != 2)
            continue; // levels that cannot be written
        DngImage image;
        image.width = real.pixels.width;
        image.height = real.pixels.height;
        image.planes = real.pixels.channels;
        image.shorts = real.pixels.shorts;
        image.row_stride = real.pixels.row_stride;
        image.cfa_pattern = real.facts.cfa_pattern;
        image.black_rows = real.pixels.black.rows;
        image.black_columns = real.pixels.black.columns;
        image.black = real.pixels.black.pattern;
        image.white[0] = std::uint32_t(real.pixels.white[0]);
        image.facts = real.facts;
        for (const auto compression : { DngCompression::none, DngCompression::lossless }) {
            written(folder.path("a.dng"), image, { compression, 16, DngLayout::standard, 0 });
            const RawImage again = decoded(folder.path("a.dng"));
            CHECK(different_samples(again.pixels, image) == 0);
            CHECK(again.pixels.black.pattern == real.pixels.black.pattern);
            CHECK(again.facts.white_level == real.facts.white_level);
            CHECK(again.facts.cfa_pattern == real.facts.cfa_pattern);
            CHECK(again.facts.orientation == real.facts.orientation);
            CHECK(again.facts.make == real.facts.make);
            CHECK((again.facts.model == real.facts.model || real.facts.model.empty()));
            CHECK((again.facts.as_shot_neutral == real.facts.as_shot_neutral || real.facts.as_shot_neutral[0] == 0));
            CHECK(again.facts.iso == real.facts.iso);
            REQUIRE(again.facts.color_matrices.size() == std::max<std::size_t>(real.facts.color_matrices.size(), 1));
            for (std::size_t i = 0; i < real.facts.color_matrices.size(); ++i) {
                CHECK(again.facts.color_matrices[i].xyz_to_camera == real.facts.color_matrices[i].xyz_to_camera);
                CHECK(again.facts.color_matrices[i].illuminant == real.facts.color_matrices[i].illuminant);
            }
        }
    }
}

TEST_CASE("Images that some programs do not read rightly are written, and that is noted")
{
    const ScratchFolder folder;
    MadeImage small(40, 21, 1), linear(40, 30, 3), floats(40, 30, 3);
    CHECK(written(folder.path("a.dng"), small.image) ==
          std::vector<std::string>{ "LibRaw and dcraw do not read RAW images under 22 pixels a side" });
    linear.image.black = { 0, 0, 1 };
    CHECK(written(folder.path("a.dng"), linear.image) ==
          std::vector<std::string>{
              "darktable 4.2 and RawTherapee 5.9 show three channels in wrong colours where black is above 0" });
    linear.image.black = { 0, 0, 0 };
    CHECK(written(folder.path("a.dng"), linear.image).empty());
    CHECK(
        written(folder.path("a.dng"), floats.as_floats().image, { DngCompression::none, 32, DngLayout::standard, 0 }) ==
        std::vector<std::string>{ "dcraw, LibRaw 0.20 and RawTherapee 5.9 do not read three channels of floats" });
}
