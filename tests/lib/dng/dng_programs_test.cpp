// SPDX-License-Identifier: Apache-2.0
// DNGs in other people's programs.
#include <srisp/dng.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "base/matrix3.h"
#include "lib/dng/made_dng.h"
#include "skip_unless.h"

using namespace srisp;

namespace {

bool has_program(const std::string& name)
{
    return !output_of("command -v " + name).empty();
}

/// Calls `check` with the path of a DNG of each kind of integers.
template<class Check> void for_each_kind(const Check& check)
{
    const ScratchFolder folder;
    for (const auto& [planes, width] : { std::pair(1, 600), std::pair(1, 67), std::pair(1, 1025), std::pair(3, 600) })
        for (const int bits : { 12, 16 })
            for (const auto compression : { DngCompression::none, DngCompression::lossless })
                for (const auto layout : { DngLayout::standard, DngLayout::cinema }) {
                    const bool facts = bits == 16;
                    CAPTURE(planes);
                    CAPTURE(width);
                    CAPTURE(bits);
                    CAPTURE(int(compression));
                    CAPTURE(int(layout));
                    CAPTURE(facts);
                    MadeImage made(width, 531, planes, bits);
                    made.with_preview(60, 120);
                    made.image.facts.orientation = 1;
                    if (!facts)
                        made.image.facts = {};
                    made.image.facts.noise_profile = { 1e-4, 1e-7 };
                    made.image.description = "a description";
                    written(folder.path("a.dng"), made.image, { compression, bits, layout, 0 });
                    check(folder.path("a.dng"), made.image);
                }
}

/// The samples of a binary PGM or PPM of 16 bits.
std::vector<std::uint16_t> pnm_samples(const std::string& path, int& width, int& height)
{
    std::ifstream file(path, std::ios::binary);
    std::string kind;
    int largest = 0;
    file >> kind >> width >> height >> largest;
    file.get();
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::vector<std::uint16_t> samples;
    for (std::size_t i = 0; largest == 65535 && i + 1 < bytes.size(); i += 2)
        samples.push_back(
            std::uint16_t(static_cast<unsigned char>(bytes[i]) << 8 | static_cast<unsigned char>(bytes[i + 1])));
    return samples;
}

} // namespace

TEST_CASE("exiftool has nothing to complain about")
{
    SKIP_UNLESS(has_program("exiftool"), "exiftool");
    for_each_kind([](const std::string& path, const DngImage& image) {
        const std::string verdict = output_of("exiftool -validate -warning -error -a '" + path + "'");
        // It does not know that rows of less than 16 bits end on whole bytes, and says that of all TIFF files.
        const bool rows_end_within_bytes = image.width * image.planes % 2 != 0;
        CHECK((verdict == "Validate                        : OK\n" ||
               (rows_end_within_bytes && verdict.find("StripByteCounts") != std::string::npos)));
    });
    const ScratchFolder folder;
    MadeImage made(600, 531, 3);
    made.as_floats();
    for (const int bits : { 16, 32 }) {
        written(folder.path("f.dng"), made.image, { DngCompression::deflate, bits, DngLayout::standard, 0 });
        CHECK(output_of("exiftool -validate -warning -error -a '" + folder.path("f.dng") + "'") ==
              "Validate                        : OK\n");
    }
}

TEST_CASE("dcraw decodes a mosaic to the same samples")
{
    SKIP_UNLESS(has_program("dcraw"), "dcraw");
    for_each_kind([](const std::string& path, const DngImage& image) {
        const std::string out = path.substr(0, path.size() - 4) + (image.planes == 1 ? ".pgm" : ".ppm");
        CHECK(output_of("cd / && timeout 60 dcraw -D -4 -t 0 '" + path + "'") == "");
        int width = 0, height = 0;
        const std::vector<std::uint16_t> samples = pnm_samples(out, width, height);
        CHECK(width == image.width);
        CHECK(height == image.height);
        const std::size_t count = std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.planes);
        CHECK(samples == std::vector<std::uint16_t>(image.shorts, image.shorts + count));
        std::filesystem::remove(out);
    });
}

TEST_CASE("dcraw_emu develops it")
{
    SKIP_UNLESS(has_program("dcraw_emu"), "dcraw_emu");
    for_each_kind([](const std::string& path, const DngImage& image) {
        CHECK(output_of("timeout 60 dcraw_emu -4 -w -o 1 '" + path + "'") == "");
        int width = 0, height = 0;
        const std::vector<std::uint16_t> samples = pnm_samples(path + ".ppm", width, height);
        CHECK(width == image.width);
        CHECK(height == image.height);
        CHECK(samples.size() == std::size_t(image.width) * std::size_t(image.height) * 3);
        std::filesystem::remove(path + ".ppm");
    });
}

TEST_CASE("dcraw and dcraw_emu develop a colour to what the camera's matrix and neutral say it is")
{
    SKIP_UNLESS(has_program("dcraw"), "dcraw");
    SKIP_UNLESS(has_program("dcraw_emu"), "dcraw_emu");
    const ScratchFolder folder;
    MadeImage made(64, 48, 3);
    made.image.facts.orientation = 1;
    const std::array<float, 3> linear{ 0.3f, 0.4f, 0.2f }, neutral = made.image.facts.as_shot_neutral;
    const Matrix3 camera = row_normalized(product(made.image.facts.color_matrices[1].xyz_to_camera, kSrgbToXyz));
    made.image.black = { 1000, 1000, 1000 };
    for (std::size_t i = 0; i < std::size_t(64 * 48 * 3); ++i) {
        const float* row = camera.data() + i % 3 * 3;
        const float value = neutral[i % 3] * (row[0] * linear[0] + row[1] * linear[1] + row[2] * linear[2]);
        made.sample(i) = std::uint16_t(1000 + 64535 * value);
    }
    written(folder.path("a.dng"), made.image);
    for (const auto& [program, suffix] : { std::pair("dcraw", "a.ppm"), std::pair("dcraw_emu", "a.dng.ppm") }) {
        CAPTURE(std::string(program));
        CHECK(output_of(std::string("timeout 60 ") + program + " -4 -w -o 1 '" + folder.path("a.dng") + "'") == "");
        int width = 0, height = 0;
        const std::vector<std::uint16_t> samples = pnm_samples(folder.path(suffix), width, height);
        REQUIRE(samples.size() == 64 * 48 * 3);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(samples[(20 * 64 + 30) * 3 + c] / 65535.0f == doctest::Approx(linear[c]).epsilon(0.02));
    }
}
