// SPDX-License-Identifier: Apache-2.0
// Each file of the shared data/raw: levels, phase, size and channel means, all established without our code:
//   levels, phase, size   dcraw -v -4 -T -o 0 ("darkness", "saturation"), dcraw -i -v ("Filter pattern", "Image size"),
//                         and for DNG `exiftool -n -G1 -s`, whose tags win where dcraw rounds
//   means                 dcraw -D -4 -t 0 -c FILE > f.pgm; then in Python, over the whole picture, per colour of the
//   pattern:
//                         the mean of min(1, max(0, (value - black[position]) / (white - black[position])))
#include <srisp/reference.h>

#include <array>
#include <cmath>

#include "base/file_bytes.h"
#include "reference/decoders.h"
#include "reference/dng_description.h"
#include "shared_files.h"

using namespace srisp;

namespace {

struct RawCase {
    const char *file, *make, *model;
    int width, height, orientation;
    const char* pattern;
    std::array<float, 4> black;
    float white;
    std::array<double, 3> mean;   // dcraw -D
    std::array<float, 3> neutral; // dcraw -i -v, "Camera multipliers", or AsShotNeutral; 0: none there
    float iso, exposure_time_s, f_number;
};

const RawCase kCases[] = {
    { "apple_quicktake.qtk",
      "Apple",
      "QuickTake 100",
      640,
      480,
      1,
      "GRBG",
      { 0, 0, 0, 0 },
      1023,
      { 0.339265, 0.325943, 0.309836 },
      { 0, 0, 0 },
      0,
      0,
      0 },
    // White 51080 is what the LinearizationTable maps to; dcraw and the tags agree.
    { "blackmagic_pocket.dng",
      "",
      "Blackmagic Pocket Cinema Camera",
      1952,
      1112,
      1,
      "GBRG",
      { 256, 256, 256, 256 },
      51080,
      { 0.005147, 0.010399, 0.011465 },
      { 0.8722f, 1, 0.5928f },
      0,
      0,
      0 },
    // dcraw's "darkness 127" is the least of its four levels: means of the masked columns 2 … 45 (dcraw -E), cut to
    // integers, are 127, 128, 128, 128.
    { "canon_eos_d30.crw",
      "Canon",
      "EOS D30",
      2176,
      1448,
      1,
      "RGGB",
      { 127, 128, 128, 128 },
      4095,
      { 0.113996, 0.094163, 0.042004 },
      { 0, 0, 0 },
      100,
      4.96743f,
      5.59592f },
    // The writer left exposure, f-number and ISO 0 in the Exif folder.
    { "canon_kiss_x4.dng",
      "Canon",
      "Canon EOS Kiss X4",
      1734,
      1156,
      1,
      "RGGB",
      { 2056, 2056, 2056, 2056 },
      15000,
      { 0.025908, 0.055998, 0.040737 },
      { 0.403714f, 1, 0.590230f },
      0,
      0,
      0 },
    { "canon_powershot_g2.crw",
      "Canon",
      "PowerShot G2",
      2312,
      1720,
      1,
      "RGGB",
      { 32, 32, 32, 32 },
      1023,
      { 0.148891, 0.185221, 0.101589 },
      { 1036.0f / 1679, 1, 1036.0f / 1663 },
      50,
      0.0198289f,
      4 },
    { "canon_powershot_s40.crw",
      "Canon",
      "PowerShot S40",
      2312,
      1720,
      1,
      "RGGB",
      { 32, 32, 32, 32 },
      1023,
      { 0.176513, 0.372908, 0.314434 },
      { 1064.0f / 2431, 1, 1064.0f / 1198 },
      50,
      0.0166741f,
      2.79796f },
    { "gopro_hero6.dng",
      "GoPro",
      "HERO6 Black",
      4000,
      3000,
      2,
      "RGGB",
      { 0, 0, 0, 0 },
      16383,
      { 0.078964, 0.132588, 0.092364 },
      { 0.522449f, 1, 0.571429f },
      100,
      0.0021978f,
      2.8f },
    { "kodak_dc120.kdc",
      "Kodak",
      "DC120",
      848,
      976,
      1,
      "GRBG",
      { 0, 0, 0, 0 },
      510,
      { 0.342298, 0.269598, 0.252289 },
      { 0, 0, 0 },
      160,
      0.00376f,
      3.7f },
    // exiftool reads WB_RBLevels 1.977 1.289, but the D1 applied them to the signal before it was digitised (LibRaw
    // knows; dcraw divides by constants of its own, to 0.960 1 1.041): the stored neutral is near (1, 1, 1), as the
    // stones show.
    { "nikon_d1.nef",
      "Nikon",
      "D1",
      2012,
      1324,
      1,
      "BGGR",
      { 0, 0, 0, 0 },
      4095,
      { 0.115210, 0.119778, 0.107643 },
      { 1, 1, 1 },
      200,
      0.004f,
      7.6f },
    { "pi_640x480.dng",
      "",
      "",
      640,
      480,
      1,
      "GBRG",
      { 0, 0, 0, 0 },
      1023,
      { 0.231285, 0.161734, 0.231170 },
      { 0, 0, 0 },
      0,
      0,
      0 },
    { "raspberry_pi.dng",
      "RaspberryPi",
      "PiDNG / PiCamera2",
      1456,
      1088,
      1,
      "BGGR",
      { 60, 60, 60, 60 },
      1023,
      { 0.014277, 0.027972, 0.007457 },
      { 0.390076f, 1, 0.480261f },
      100,
      0.005f,
      0 },
};

/// Means per colour of all sites, as the decoder gives them.
std::array<double, 3> channel_means(const RawPixels& pixels)
{
    const RowScaler scaler(pixels);
    std::vector<float> line(std::size_t(pixels.width));
    std::array<double, 3> sum{}, count{};
    for (int y = 0; y < pixels.height; ++y) {
        scaler.scale(y, line.data());
        for (int x = 0; x < pixels.width; ++x) {
            sum[std::size_t(pixels.cfa.color(y, x))] += line[std::size_t(x)];
            count[std::size_t(pixels.cfa.color(y, x))] += 1;
        }
    }
    return { sum[0] / count[0], sum[1] / count[1], sum[2] / count[2] };
}

RawImage decode(const std::string& path)
{
    const auto file = read_whole_file(path);
    REQUIRE(file);
    const auto dng = describe_dng(*file);
    REQUIRE(dng);
    auto image = decode_with_libraw(*file, *dng ? &**dng : nullptr);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return *image;
}

std::array<double, 3> thumbnail_mean(const Thumbnail& thumbnail, Roi roi)
{
    std::array<double, 3> sum{};
    for (int y = roi.y0; y < roi.y1; ++y)
        for (int x = roi.x0; x < roi.x1; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += double(thumbnail.view().pixel(x, y)[c]);
    const double count = double(roi.x1 - roi.x0) * (roi.y1 - roi.y0);
    return { sum[0] / count, sum[1] / count, sum[2] / count };
}

} // namespace

TEST_CASE("Levels, phase, size and camera of each shared RAW file are what dcraw and exiftool say")
{
    SKIP_WITHOUT_SHARED("data/raw");
    for (const RawCase& expected : kCases) {
        CAPTURE(expected.file);
        const auto reference = load_reference(shared_file(std::string("data/raw/") + expected.file));
        REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
        const CameraFacts& facts = (*reference)->facts;
        CHECK((*reference)->name == expected.file);
        CHECK(facts.make == expected.make);
        CHECK(facts.model == expected.model);
        CHECK(facts.width == expected.width);
        CHECK(facts.height == expected.height);
        CHECK(facts.orientation == expected.orientation);
        CHECK(facts.cfa_pattern == expected.pattern);
        CHECK(facts.white_level == expected.white);
        for (std::size_t i = 0; i < 4; ++i)
            CHECK(facts.black_level[i] == expected.black[i]);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(facts.as_shot_neutral[c] == doctest::Approx(expected.neutral[c]).epsilon(1e-4));
        CHECK(facts.iso == expected.iso);
        CHECK(facts.exposure_time_s == doctest::Approx(expected.exposure_time_s).epsilon(1e-4));
        CHECK(facts.f_number == doctest::Approx(expected.f_number).epsilon(1e-4));
    }
}

TEST_CASE(
    "Channel means of each shared RAW file after black and white are those of dcraw -D, and the thumbnail keeps them")
{
    SKIP_WITHOUT_SHARED("data/raw");
    for (const RawCase& expected : kCases) {
        CAPTURE(expected.file);
        const std::string path = shared_file(std::string("data/raw/") + expected.file);
        const auto means = channel_means(decode(path).pixels);
        const auto reference = load_reference(path);
        REQUIRE(reference);
        const auto squashed = thumbnail_mean((*reference)->thumbnail, { 0, kThumbnailSize, 0, kThumbnailSize });
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(means[c] == doctest::Approx(expected.mean[c]).epsilon(2e-5));
            // Cells weigh their sites by their own number of them, so not to the last digit.
            CHECK(squashed[c] == doctest::Approx(expected.mean[c]).epsilon(5e-3));
        }
    }
}

TEST_CASE("DNG colour matrices, illuminants and noise profile come from the file's tags")
{
    SKIP_WITHOUT_SHARED("data/raw");
    const auto gopro = load_reference(shared_file("data/raw/gopro_hero6.dng"));
    REQUIRE(gopro);
    const CameraFacts& facts = (*gopro)->facts;
    REQUIRE(facts.color_matrices.size() == 2);
    CHECK(facts.color_matrices[0].illuminant == 3);
    CHECK(facts.color_matrices[1].illuminant == 23);
    const std::array<float, 9> first{
        1.8331f, -0.8166f, -0.2478f, 0.1391f, 0.8961f, -0.0367f, 0.0822f, 0.0662f, 0.2597f
    };
    for (std::size_t i = 0; i < 9; ++i)
        CHECK(facts.color_matrices[0].xyz_to_camera[i] == doctest::Approx(first[i]));
    REQUIRE(facts.noise_profile.size() == 2);
    CHECK(facts.noise_profile[0] == doctest::Approx(0.000156201000208966));
    CHECK(facts.noise_profile[1] == doctest::Approx(4.88001994369824e-08));
    REQUIRE((*gopro)->notes.size() == 1);
    CHECK((*gopro)->notes[0] == "OpcodeList2 of the DNG (gain maps and other corrections) was ignored");

    // Not in the file, so from LibRaw's table, and noted.
    const auto d1 = load_reference(shared_file("data/raw/nikon_d1.nef"));
    REQUIRE(d1);
    REQUIRE((*d1)->facts.color_matrices.size() == 1);
    CHECK((*d1)->facts.color_matrices[0].illuminant == 21);
    CHECK((*d1)->facts.color_matrices[0].xyz_to_camera[0] == doctest::Approx(0.7637));
    CHECK((*d1)->notes.size() == 1);
}

TEST_CASE("The reference's hash is that of the file's bytes")
{
    SKIP_WITHOUT_SHARED("data/raw/raspberry_pi.dng");
    const auto reference = load_reference(shared_file("data/raw/raspberry_pi.dng"));
    REQUIRE(reference);
    CHECK((*reference)->hash == "xxh128:e0c43cfc8a41c14a845516f5d4b9af8b"); // xxh128sum
}

TEST_CASE("Neutral things are neutral under the as-shot neutral")
{
    SKIP_WITHOUT_SHARED("data/raw");
    struct {
        const char *file, *thing;
        Roi roi; // of the upright thumbnail
    } const scenes[] = {
        { "canon_powershot_s40.crw", "white box, above the text", { 160, 175, 60, 70 } },
        { "canon_powershot_s40.crw", "white box, in the text", { 200, 225, 100, 110 } },
        { "gopro_hero6.dng", "concrete floor", { 90, 130, 200, 230 } },
        { "nikon_d1.nef", "sunlit stone", { 225, 245, 70, 90 } },
    };
    for (const auto& scene : scenes) {
        CAPTURE(scene.thing);
        const auto reference = load_reference(shared_file(std::string("data/raw/") + scene.file));
        REQUIRE(reference);
        const auto mean = thumbnail_mean((*reference)->thumbnail, scene.roi);
        const auto& neutral = (*reference)->facts.as_shot_neutral;
        CHECK(mean[0] / mean[1] == doctest::Approx(neutral[0]).epsilon(0.06));
        CHECK(mean[2] / mean[1] == doctest::Approx(neutral[2]).epsilon(0.06));
    }
}

TEST_CASE("Grey patches from light to dark have one colour, which a wrong black level would tint")
{
    SKIP_WITHOUT_SHARED("data/raw/canon_powershot_g2.crw");
    const auto reference = load_reference(shared_file("data/raw/canon_powershot_g2.crw"));
    REQUIRE(reference);
    // Neutral 8, 6.5, 5 and 3.5 of the chart: 0.36 to 0.11 in green.
    const auto light = thumbnail_mean((*reference)->thumbnail, { 100, 135, 140, 200 });
    for (const Roi roi : { Roi{ 160, 195, 140, 200 }, Roi{ 220, 245, 140, 200 } }) {
        const auto dark = thumbnail_mean((*reference)->thumbnail, roi);
        CHECK(dark[0] / dark[1] == doctest::Approx(light[0] / light[1]).epsilon(0.05));
        CHECK(dark[2] / dark[1] == doctest::Approx(light[2] / light[1]).epsilon(0.02));
    }
}

TEST_CASE("A black frame and a four-colour sensor are refused, each with its own message")
{
    SKIP_WITHOUT_SHARED("data/raw");
    const std::string dark = shared_file("data/raw/google_pixel7_dark.dng");
    const auto black_frame = load_reference(dark);
    REQUIRE(!black_frame);
    CHECK(black_frame.error().message ==
          "reference '" + dark + "': is a black frame: 98 % of its values are at or below 0.00072, the limit is 0.005");

    const std::string cmyg = shared_file("data/raw/canon_powershot_g1_cmyg.crw");
    const auto four = load_reference(cmyg);
    REQUIRE(!four);
    CHECK(four.error().message ==
          "reference '" + cmyg + "': sensor with 4 filter colours (GMCY): only R, G, B are supported");
}

TEST_CASE("The Pixel's black level per position is read in fractions, which dcraw cuts to 1023")
{
    SKIP_WITHOUT_SHARED("data/raw/google_pixel7_dark.dng");
    const RawImage image = decode(shared_file("data/raw/google_pixel7_dark.dng"));
    // exiftool -BlackLevel: 1024.554688 1024.730469 1023.78125 1023.929688, -WhiteLevel: 16368
    const float expected[] = { 1024.554688f, 1024.730469f, 1023.929688f, 1023.78125f }; // R, first G, B, second G
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(image.facts.black_level[i] == doctest::Approx(expected[i]));
    CHECK(image.facts.white_level == 16368);
    CHECK(image.facts.orientation == 8);
    // dcraw -D, as above, with these levels: fractions of a step, so the rounding of dcraw would show.
    const auto means = channel_means(image.pixels);
    CHECK(means[0] == doctest::Approx(0.000234).epsilon(0.005));
    CHECK(means[1] == doctest::Approx(0.000201).epsilon(0.005));
    CHECK(means[2] == doctest::Approx(0.000218).epsilon(0.005));
}
