// SPDX-License-Identifier: Apache-2.0
#include <srisp/dng.h>

#include <cmath>
#include <filesystem>

#include "lib/dng/made_dng.h"

using namespace srisp;

namespace {

/// Why it is not written, without "DNG '…': "; nothing is left then.
std::string refusal(const DngImage& image, const DngOptions& options = {})
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    const auto notes = write_dng(path, image, options);
    CHECK(std::filesystem::is_empty(folder.path()));
    if (notes)
        return "(it was written)";
    const std::string begin = "DNG '" + path + "': ";
    CHECK(notes.error().message.compare(0, begin.size(), begin) == 0);
    return notes.error().message.substr(begin.size());
}

DngOptions with(DngCompression compression, int bits, DngLayout layout = DngLayout::standard)
{
    return { compression, bits, layout, 0 };
}

} // namespace

TEST_CASE("DNG: sizes, channels and phases that cannot be")
{
    MadeImage made(40, 30, 1);
    DngImage image = made.image;
    image.width = 65536;
    CHECK(refusal(image) == "image of 65536 x 30 pixels: from 2 to 65535 a side are possible");
    image.width = 40;
    image.height = 1;
    CHECK(refusal(image) == "image of 40 x 1 pixels: from 2 to 65535 a side are possible");
    image = made.image;
    image.planes = 4;
    CHECK(refusal(image) == "image of 4 channels: 1 (a mosaic) or 3 (R, G, B) are possible");
    image.planes = 2;
    CHECK(refusal(image) == "image of 2 channels: 1 (a mosaic) or 3 (R, G, B) are possible");
    image = made.image;
    image.cfa_pattern = "RGBG";
    CHECK(refusal(image) == "mosaic with the filters 'RGBG': RGGB, GRBG, GBRG and BGGR are possible");
    image = made.image;
    image.shorts = nullptr;
    CHECK(refusal(image) == "either integers or floats are needed");
}

TEST_CASE("DNG: bits and compressions that do not go with the samples")
{
    MadeImage made(40, 30, 3);
    CHECK(refusal(made.image, with(DngCompression::lossless, 9)) == "integers of 9 bits: 10 to 16 are possible");
    CHECK(refusal(made.image, with(DngCompression::none, 32)) == "integers of 32 bits: 10 to 16 are possible");
    CHECK(refusal(made.image, with(DngCompression::deflate, 16)) ==
          "compression 'deflate' is for floats: integers can have 'none' or 'lossless'");
    made.as_floats();
    CHECK(refusal(made.image, with(DngCompression::none, 24)) == "floats of 24 bits: 16 and 32 are possible");
    CHECK(refusal(made.image, with(DngCompression::lossless, 16)) ==
          "compression 'lossless' is for integers: floats can have 'none' or 'deflate'");
    CHECK(refusal(made.image, with(DngCompression::none, 16, DngLayout::cinema)) ==
          "layout 'cinema' is for integers, not for floats");
    made.image.planes = 1;
    made.image.cfa_pattern = "RGGB";
    CHECK(refusal(made.image, with(DngCompression::none, 32)) ==
          "mosaic of floats: few programs read that; integers or three channels are possible");
}

TEST_CASE("DNG: samples that do not fit, the first one named")
{
    MadeImage made(40, 30, 1, 12);
    made.sample(40 * 7 + 5) = 4096;
    made.sample(40 * 9) = 5000;
    CHECK(refusal(made.image, with(DngCompression::lossless, 12)) ==
          "sample of 4096 at pixel (5, 7): it does not fit into 12 bits");
    MadeImage floats(40, 30, 3);
    floats.as_floats().float_sample((40 * 2 + 3) * 3 + 1) = NAN;
    CHECK(refusal(floats.image, with(DngCompression::none, 32)) == "NaN or infinity at pixel (3, 2)");
    floats.float_sample((40 * 2 + 3) * 3 + 1) = -INFINITY;
    CHECK(refusal(floats.image, with(DngCompression::none, 32)) == "NaN or infinity at pixel (3, 2)");
    floats.float_sample((40 * 2 + 3) * 3 + 1) = 70000;
    CHECK(refusal(floats.image, with(DngCompression::deflate, 16)) ==
          "sample of 70000.000000 at pixel (3, 2): 65504 is the limit of floats of 16 bits");
}

TEST_CASE("DNG: levels and previews that cannot be")
{
    MadeImage made(40, 30, 1, 12);
    DngImage image = made.image;
    image.white[0] = 4096;
    CHECK(refusal(image, with(DngCompression::none, 12)) == "white level 4096: 4095 is the limit");
    image.white[0] = 64;
    image.black = { 64 };
    CHECK(refusal(image) == "black level 64.000000: it must lie from 0 to below the white level, 64");
    image.black = { NAN };
    CHECK(refusal(image) == "black level nan: it must lie from 0 to below the white level, 64");
    image.black = { 1, 2 };
    CHECK(refusal(image) == "2 black levels where their pattern needs 1");
    image.black_rows = 0;
    CHECK(refusal(image) == "black levels in a pattern of 0 x 1: 1 to 64 are possible");
    image = made.image;
    image.baseline_exposure = NAN;
    CHECK(refusal(image) == "baseline exposure nan: -100 to 100 are possible");
    made.with_preview(41, 5);
    CHECK(refusal(made.image) == "preview of 41 x 5 pixels: 1 x 1 to the image's 40 x 30 are possible");
}

TEST_CASE("DNG: files of more than 4 GiB are refused before a byte is written")
{
    // Rows that all lie at the same place.
    const std::vector<std::uint16_t> row(65535);
    DngImage image;
    image.width = image.height = 65535;
    image.shorts = row.data();
    image.cfa_pattern = "RGGB";
    const std::string message = refusal(image, with(DngCompression::none, 16));
    CHECK(message.compare(0, 12, "file of 8589") == 0);
    CHECK(message.find(" bytes: 4294967295 are the limit") != std::string::npos);
}

TEST_CASE("DNG: what the file system refuses is said, with the file's name")
{
    MadeImage made(40, 30, 1);
    const auto missing = write_dng("/nowhere/a.dng", made.image);
    REQUIRE(!missing);
    CHECK(missing.error().message == "'/nowhere/a.dng' cannot be created: No such file or directory");
    const auto full = write_dng("/dev/full", made.image);
    REQUIRE(!full);
    CHECK(full.error().message == "'/dev/full' cannot be written: No space left on device");
}
