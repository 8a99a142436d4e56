// SPDX-License-Identifier: Apache-2.0
// DNGs that hold srisp's record come in as the RAW-like images that they were made from.
#include <srisp/dng.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <srisp/metadata.h>

#include "container/file_description.h"
#include "container/image_file.h"
#include "lib/container/made_files.h"
#include "record/record.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

/// A smooth RAW-like picture in [0,1], of other colours at each place.
float color_at(double x, double y, int channel)
{
    return float(0.45 + 0.3 * std::sin(0.021 * x + channel) * std::cos(0.017 * y - channel) + 0.1 * channel);
}

/// How a DNG is made of it. Black levels: row by row of 2 x 2, or of three planes.
struct Case {
    int width = 300, height = 202, planes = 1;
    std::string phase = "RGGB";
    std::vector<float> black{ 0, 0, 0, 0 };
    std::array<std::uint32_t, 3> white{ 65535, 65535, 65535 };
    DngOptions options;
    int orientation = 1;
    bool preview = false;
    bool floats = false;
};

std::string record_text()
{
    return format_record({ Direction::reverse, R"({"model": "m"})", std::string(2000, 'd'), "" });
}

std::vector<std::string> write_case(const std::string& path, const Case& of, const std::string& description)
{
    std::vector<std::uint16_t> samples;
    std::vector<float> floats;
    for (int y = 0; y < of.height; ++y)
        for (int x = 0; x < of.width; ++x)
            for (int plane = 0; plane < of.planes; ++plane) {
                const std::size_t place = std::size_t(y % 2 * 2 + x % 2);
                const char letter = of.phase[place];
                const int color = of.planes == 3 ? plane : letter == 'R' ? 0 : letter == 'G' ? 1 : 2;
                const float black = of.black[of.planes == 3 ? std::size_t(plane) : place];
                const float white = float(of.white[of.planes == 3 ? std::size_t(plane) : 0]);
                floats.push_back(color_at(x, y, color));
                samples.push_back(std::uint16_t(std::lround(black + (white - black) * color_at(x, y, color))));
            }
    const std::vector<std::uint8_t> preview(std::size_t(60 * 40 * 3), 128);
    DngImage image;
    image.width = of.width;
    image.height = of.height;
    image.planes = of.planes;
    image.shorts = of.floats ? nullptr : samples.data();
    image.floats = of.floats ? floats.data() : nullptr;
    image.row_stride = std::ptrdiff_t(of.width) * of.planes;
    image.black = of.black;
    image.white = of.white;
    if (of.planes == 1) {
        image.cfa_pattern = of.phase;
        image.black_rows = image.black_columns = 2;
    }
    image.facts.make = "Maker";
    image.facts.model = "Model 5";
    image.facts.orientation = of.orientation;
    image.facts.color_matrices = { { { 0.9f, -0.2f, -0.1f, -0.4f, 1.2f, 0.2f, -0.1f, 0.2f, 0.6f }, 17 },
                                   { { 0.7f, -0.1f, -0.1f, -0.4f, 1.3f, 0.2f, -0.1f, 0.2f, 0.6f }, 21 } };
    image.facts.as_shot_neutral = { 0.5f, 1, 0.6f };
    image.description = description;
    if (of.preview) {
        image.preview = preview.data();
        image.preview_width = 60;
        image.preview_height = 40;
    }
    const auto notes = write_dng(path, image, of.options);
    REQUIRE_MESSAGE(notes, (notes ? "" : notes.error().message));
    return *notes;
}

std::unique_ptr<ImageFile> opened(const std::string& path)
{
    OIIO::ImageSpec config;
    config.attribute("srisp:isolate", 0);
    auto file = ImageFile::open(path, config, "photo");
    REQUIRE_MESSAGE(file, (file ? "" : file.error().message));
    return std::move(*file);
}

/// Checks each channel against the picture.
void check_pixels(const std::string& path, const Case& of)
{
    CAPTURE(of.width);
    CAPTURE(of.height);
    CAPTURE(of.planes);
    CAPTURE(of.phase);
    CAPTURE(of.options.bits);
    CAPTURE(int(of.options.compression));
    CAPTURE(int(of.options.layout));
    CAPTURE(of.preview);
    CAPTURE(of.white[0]);
    const auto file = opened(path);
    const OIIO::ImageSpec spec = file->spec();
    REQUIRE(spec.width == of.width);
    REQUIRE(spec.height == of.height);
    REQUIRE(spec.nchannels == 3);
    std::vector<float> pixels(std::size_t(spec.image_pixels()) * 3);
    REQUIRE(file->read_image(0, 0, 0, 3, OIIO::TypeFloat, pixels.data()));
    double errors[3] = {};
    std::size_t at = 0;
    for (int y = 0; y < of.height; ++y)
        for (int x = 0; x < of.width; ++x)
            for (int c = 0; c < 3; ++c)
                errors[c] += std::fabs(double(pixels[at++]) - double(color_at(x, y, c)));
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        CHECK(errors[c] / (double(of.width) * of.height) < 1e-3);
    }
}

} // namespace

TEST_CASE("A DNG with srisp's record is read as linear camera RGB, whatever its phase, size, levels, storage")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    std::vector<Case> cases;
    for (const char* phase : { "RGGB", "GRBG", "GBRG", "BGGR" })
        for (const auto& [width, height] : { std::pair(300, 202), std::pair(301, 203), std::pair(302, 201) }) {
            Case of;
            of.width = width;
            of.height = height;
            of.phase = phase;
            of.black = { 64, 100, 30, 80 };
            of.white = { 4000, 0, 0 };
            of.options.bits = 12;
            cases.push_back(of);
        }
    for (const int planes : { 1, 3 })
        for (const auto layout : { DngLayout::standard, DngLayout::cinema })
            for (const auto compression : { DngCompression::none, DngCompression::lossless })
                for (const auto& [bits, white] :
                     { std::pair(10, 1023), std::pair(12, 3000), std::pair(14, 16000), std::pair(16, 60000) }) {
                    Case of;
                    of.planes = planes;
                    of.preview = layout == DngLayout::standard;
                    of.black = { 64, 0, 20, 300 };
                    of.white = { std::uint32_t(white), 0, 0 };
                    if (planes == 3) {
                        of.black = { 64, 20, 10 };
                        of.white = { std::uint32_t(white) - 200, std::uint32_t(white) - 100, std::uint32_t(white) };
                    }
                    of.options = { compression, bits, layout, 0 };
                    cases.push_back(of);
                }
    Case fractions; // LibRaw rounds
    fractions.black = { 64.5f, 63.25f, 64.75f, 64.5f };
    fractions.white = { 1000, 0, 0 };
    fractions.options.bits = 10;
    cases.push_back(fractions);
    for (const Case& of : cases) {
        write_case(path, of, record_text());
        check_pixels(path, of);
    }
}

TEST_CASE("A DNG with srisp's record keeps it whole, with what is known of the camera; pixels stay as stored")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    Case of;
    of.orientation = 6;
    of.phase = "GBRG";
    of.black = { 64, 100, 30, 80 };
    of.white = { 4000, 0, 0 };
    of.options.bits = 12;
    of.preview = true;
    write_case(path, of, record_text());
    check_pixels(path, of);
    const auto file = opened(path);
    const OIIO::ImageSpec spec = file->spec();
    CHECK(spec.get_string_attribute("ImageDescription") == record_text());
    CHECK(is_unprocessed(spec));
    CHECK(spec.get_string_attribute("oiio:ColorSpace") == kCameraColorSpace);
    CHECK(spec.get_int_attribute("Orientation") == 6);
    CHECK(note_list(spec).empty());
    const CameraFacts facts = recorded_sensor(spec);
    CHECK(facts.make == "Maker");
    CHECK(facts.model == "Model 5");
    CHECK(facts.cfa_pattern == "GBRG");
    CHECK(facts.black_level == std::array<float, 4>{ 30, 64, 100, 80 });
    CHECK(facts.white_level == 4000);
    CHECK(facts.as_shot_neutral == std::array<float, 3>{ 0.5f, 1, 0.6f });
    REQUIRE(facts.color_matrices.size() == 2);
    CHECK(facts.color_matrices[0].illuminant == 21);
    CHECK(facts.color_matrices[1].xyz_to_camera[0] == 0.9f);
}

TEST_CASE("A DNG with srisp's record is one whatever it is called")
{
    const ScratchFolder folder;
    write_case(folder.path("a.tif"), {}, record_text());
    check_pixels(folder.path("a.tif"), {});
}

TEST_CASE("A DNG of floats with srisp's record is read as it was written, with a preview or without")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    for (const bool preview : { false, true })
        for (const auto compression : { DngCompression::none, DngCompression::deflate })
            for (const int bits : { 16, 32 }) {
                Case of;
                of.width = 301;
                of.planes = 3;
                of.floats = true;
                of.preview = preview;
                of.black = { 0, 0, 0 };
                of.white = { 1, 1, 1 };
                of.orientation = 8;
                of.options = { compression, bits, DngLayout::standard, 0 };
                write_case(path, of, record_text());
                check_pixels(path, of);
                const OIIO::ImageSpec spec = opened(path)->spec();
                CHECK(is_unprocessed(spec));
                CHECK(spec.get_int_attribute("Orientation") == 8);
                CHECK(spec.get_string_attribute("oiio:ColorSpace") == kCameraColorSpace);
            }
}

TEST_CASE("A DNG with srisp's record whose levels cannot be used is refused")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    Case of;
    of.planes = 3;
    of.floats = true;
    of.black = { 0, 0, 0 };
    of.white = { 2, 2, 2 };
    of.options = { DngCompression::none, 32, DngLayout::standard, 0 };
    write_case(path, of, record_text());
    const auto file = ImageFile::open(path, {}, "photo 'a.dng'");
    REQUIRE(!file);
    CHECK(file.error().message ==
          "photo 'a.dng': is a DNG that srisp wrote, with filters or levels that its readers cannot use");
}

TEST_CASE("A DNG with srisp's record that breaks off is an error, unless what is there is wanted")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    write_case(path, {}, record_text());
    const std::string whole = bytes_of(path);
    write_bytes(path, whole.substr(0, whole.size() / 2));
    OIIO::ImageSpec config;
    config.attribute("srisp:isolate", 0);
    const auto file = ImageFile::open(path, config, "photo 'a.dng'");
    REQUIRE(!file);
    CHECK(file.error().message.rfind("photo 'a.dng': truncated: image data end at byte ", 0) == 0);
    config.attribute("srisp:allow_partial", 1);
    const auto part = ImageFile::open(path, config, "photo 'a.dng'");
    REQUIRE_MESSAGE(part, (part ? "" : part.error().message));
    REQUIRE((*part)->reading_notes().size() == 1);
}

TEST_CASE("A DNG with srisp's record that is too small for LibRaw is refused with its size")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    Case of;
    of.width = 30;
    of.height = 21;
    write_case(path, of, record_text());
    const auto file = ImageFile::open(path, {}, "photo 'a.dng'");
    REQUIRE(!file);
    CHECK(file.error().message == "photo 'a.dng': is a DNG of 30 x 21 pixels: LibRaw, which reads it, needs 22 a side");
    of.height = 22;
    write_case(path, of, record_text());
    CHECK(opened(path)->spec().height == 22);
}

TEST_CASE("Harmful tags in a DNG with srisp's record do not reach LibRaw")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    write_case(path, {}, record_text());
    std::string bytes = bytes_of(path);
    const std::size_t next = 8 + 2 + 12 * std::size_t(static_cast<unsigned char>(bytes[8]));
    bytes.replace(next, 4, little_endian(8)); // the first folder follows itself
    write_bytes(path, bytes);
    OIIO::ImageSpec config;
    config.attribute("srisp:isolate", 0);
    const auto file = ImageFile::open(path, config, "photo 'a.dng'");
    REQUIRE(!file);
    CHECK(file.error().message.find("form a loop") != std::string::npos);
}

TEST_CASE("Hints for RAW files do not change a DNG with srisp's record")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    write_case(path, {}, record_text());
    OIIO::ImageSpec config;
    config.attribute("srisp:isolate", 0);
    config.attribute("raw:Demosaic", "none");
    config.attribute("raw:ColorSpace", "ACES");
    const auto file = ImageFile::open(path, config, "photo");
    REQUIRE(file);
    CHECK((*file)->spec().nchannels == 3);
    CHECK((*file)->spec().get_string_attribute("oiio:ColorSpace") == kCameraColorSpace);
}

TEST_CASE("A DNG without srisp's record, or with that of a processed picture, is a photo as ever")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dng");
    for (const std::string& text :
         { std::string("a tree"), std::string(), format_record({ Direction::forward, R"({"model": "m"})", "", "" }) }) {
        write_case(path, {}, text);
        const OIIO::ImageSpec spec = opened(path)->spec();
        CHECK(spec.get_string_attribute("oiio:ColorSpace") == "sRGB");
        CHECK(!is_unprocessed(spec));
    }
}
