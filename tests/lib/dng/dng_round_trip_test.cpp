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

/// What was decoded, to be written; `raw` must outlive it.
DngImage image_of(const RawImage& raw)
{
    DngImage image;
    image.width = raw.pixels.width;
    image.height = raw.pixels.height;
    image.planes = raw.pixels.channels;
    image.shorts = raw.pixels.shorts;
    image.row_stride = raw.pixels.row_stride;
    image.cfa_pattern = raw.facts.cfa_pattern;
    image.black_rows = raw.pixels.black.rows;
    image.black_columns = raw.pixels.black.columns;
    image.black = raw.pixels.black.pattern;
    image.white[0] = std::uint32_t(raw.pixels.white[0]);
    image.facts = raw.facts;
    return image;
}

constexpr int kD65 = 21; // EXIF LightSource

/// What is not known is not compared where a DNG must say something.
void check_same_facts(const CameraFacts& facts, const CameraFacts& expected)
{
    CHECK(facts.make == expected.make);
    CHECK((facts.model == expected.model || expected.model.empty()));
    CHECK(facts.width == expected.width);
    CHECK(facts.height == expected.height);
    CHECK(facts.orientation == expected.orientation);
    CHECK(facts.cfa_pattern == expected.cfa_pattern);
    CHECK(facts.black_level == expected.black_level);
    CHECK(facts.white_level == expected.white_level);
    CHECK((facts.as_shot_neutral == expected.as_shot_neutral || expected.as_shot_neutral[0] == 0));
    CHECK(facts.iso == expected.iso);
    CHECK(facts.exposure_time_s == expected.exposure_time_s);
    CHECK(facts.f_number == expected.f_number);
    CHECK(facts.noise_profile == expected.noise_profile);
    REQUIRE(facts.color_matrices.size() == std::max<std::size_t>(expected.color_matrices.size(), 1));
    for (std::size_t i = 0; i < expected.color_matrices.size(); ++i) {
        CHECK(facts.color_matrices[i].xyz_to_camera == expected.color_matrices[i].xyz_to_camera);
        const int illuminant = expected.color_matrices[i].illuminant;
        CHECK(facts.color_matrices[i].illuminant == (illuminant ? illuminant : kD65));
    }
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
    const std::string copy = folder.path("a.dng");
    for (const char* name :
         { "blackmagic_pocket.dng", "canon_eos_d30.crw", "canon_kiss_x4.dng", "canon_powershot_s40.crw",
           "gopro_hero6.dng", "nikon_d1.nef", "pi_640x480.dng", "raspberry_pi.dng", "google_pixel7_dark.dng" }) {
        CAPTURE(std::string(name));
        const RawImage real = decoded(shared_file("data/raw/" + std::string(name)));
        REQUIRE(real.pixels.black.by_column.empty()); // could not be written
        REQUIRE(real.pixels.black.by_row.empty());
        const DngImage image = image_of(real);
        for (const auto& [compression, layout] : { std::pair(DngCompression::none, DngLayout::standard),
                                                   std::pair(DngCompression::lossless, DngLayout::standard),
                                                   std::pair(DngCompression::lossless, DngLayout::cinema) }) {
            written(copy, image, { compression, 16, layout, 0 });
            const RawImage again = decoded(copy);
            CHECK(different_samples(again.pixels, image) == 0);
            CHECK(again.pixels.black.pattern == real.pixels.black.pattern);
            check_same_facts(again.facts, real.facts);
            CHECK(raw_thumbnail(again.pixels).rgb == raw_thumbnail(real.pixels).rgb);
        }
    }
}

TEST_CASE("A reference of a real camera and its DNG are the same reference")
{
    SKIP_WITHOUT_SHARED("data/raw");
    const ScratchFolder folder;
    const std::string copy = folder.path("a.dng");
    for (const char* name : { "blackmagic_pocket.dng", "canon_kiss_x4.dng", "pi_640x480.dng", "raspberry_pi.dng" }) {
        CAPTURE(std::string(name));
        const std::string path = shared_file("data/raw/" + std::string(name));
        const auto before = load_reference(path, false);
        REQUIRE_MESSAGE(before, (before ? "" : before.error().message));
        const RawImage real = decoded(path);
        DngImage image = image_of(real);
        image.facts = (*before)->facts;
        image.description = R"({"srisp": "synthetic", "direction": "reverse"})";
        written(copy, image);
        const auto after = load_reference(copy, false);
        REQUIRE_MESSAGE(after, (after ? "" : after.error().message));
        check_same_facts((*after)->facts, (*before)->facts);
        CHECK((*after)->thumbnail.rgb == (*before)->thumbnail.rgb);
    }
}

TEST_CASE("A DNG with srisp's record is a RAW file to references, whatever it is called")
{
    const ScratchFolder folder;
    for (const auto compression : { DngCompression::none, DngCompression::lossless })
        for (const int planes : { 1, 3 }) {
            MadeImage made(64, 48, planes);
            made.image.description = R"({"srisp": "synthetic", "direction": "reverse"})";
            made.image.white.fill(40000);
            written(folder.path("a.tif"), made.image, { compression, 16, DngLayout::cinema, 0 });
            written(folder.path("a.dng"), made.image, { compression, 16, DngLayout::cinema, 0 });
            const auto tiff = load_reference(folder.path("a.tif"), false);
            const auto dng = load_reference(folder.path("a.dng"), false);
            REQUIRE_MESSAGE(tiff, (tiff ? "" : tiff.error().message));
            REQUIRE(dng);
            CHECK((*tiff)->facts.white_level == 40000);
            CHECK((*tiff)->thumbnail.rgb == (*dng)->thumbnail.rgb);
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
