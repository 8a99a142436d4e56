// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include <OpenImageIO/imageio.h>
#include <srisp/metadata.h>
#include <srisp/reference.h>
#include <srisp/thumbnail.h>

#include "base/shown_text.h"
#include "record/record.h"
#include "scratch_folder.h"
#include "shared_files.h"

using namespace srisp;

namespace {

/// Writes `values` (width × height × channels of the spec).
void write(const std::string& path, const OIIO::ImageSpec& spec, const std::vector<float>& values)
{
    const auto output = OIIO::ImageOutput::create(path);
    REQUIRE(output);
    REQUIRE(output->open(path, spec));
    REQUIRE(output->write_image(OIIO::TypeFloat, values.data()));
    REQUIRE(output->close());
}

std::vector<float> ramp(const OIIO::ImageSpec& spec)
{
    std::vector<float> values(spec.image_pixels() * std::size_t(spec.nchannels));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float(i % 1021) / 1020;
    return values;
}

std::string refusal(const std::string& path)
{
    const auto reference = load_reference(path);
    if (reference)
        return "(it loaded)";
    const std::string& message = reference.error().message;
    return message.substr(message.find("': ") + 3);
}

/// The spec as srisp leaves it in a result.
OIIO::ImageSpec result_of(Direction direction, OIIO::ImageSpec spec)
{
    Reference reference;
    reference.facts.make = "Maker";
    reference.facts.noise_profile = { 1e-4, 2e-7, 3e-4, 4e-7, 5e-4, 6e-7 };
    reference.facts.color_matrices.push_back({ { 1, 0, 0, 0, 2, 0, 0, 0, 3 }, 21 });
    Parameters parameters;
    parameters.white_balance = { 2, 1, 4 };
    parameters.tone_weights.fill({ 1 });
    parameters.gamma_weights = parameters.color_weights = { 1 };
    parameters.white_balance_weights = parameters.gain_weights = { 1 };
    record_result(spec, parameters, &reference.facts, direction);
    return spec;
}

} // namespace

TEST_CASE("A float EXR is taken as camera RGB: scanlines, tiles, half, extra channels, another origin")
{
    const ScratchFolder folder;
    for (const int tile : { 0, 32 })
        for (const int channels : { 3, 5 }) {
            OIIO::ImageSpec spec(130, 77, channels, channels == 3 ? OIIO::TypeFloat : OIIO::TypeHalf);
            spec.channelnames = { "R", "G", "B" };
            if (channels == 5)
                spec.channelnames.insert(spec.channelnames.end(), { "A", "Z" });
            spec.tile_width = spec.tile_height = tile;
            spec.x = 10;
            spec.y = -5;
            std::vector<float> values = ramp(spec);
            if (channels == 5) // what half holds exactly
                for (float& value : values)
                    value = std::round(value * 1024) / 1024;
            const std::string path = folder.path("a.exr");
            write(path, spec, values);
            const auto reference = load_reference(path);
            REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
            const Thumbnail expected = make_thumbnail({ values.data(), 130, 77, channels, 130 * channels });
            CHECK((*reference)->thumbnail.rgb == expected.rgb);
            REQUIRE((*reference)->notes.size() == 1);
            CHECK((*reference)->notes[0] == "taken as linear camera RGB in [0,1]: the EXR does not say what it is");
        }
}

TEST_CASE("Values outside [0,1] are clipped and counted; NaN and infinity are refused")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec(20, 10, 3, OIIO::TypeFloat);
    std::vector<float> values(600, 0.5f);
    values[3] = 2;
    values[4] = -1;
    write(folder.path("a.exr"), spec, values);
    const auto reference = load_reference(folder.path("a.exr"));
    REQUIRE(reference);
    CHECK((*reference)->thumbnail.view().pixel(20, 4)[0] == 1);
    CHECK((*reference)->thumbnail.view().pixel(20, 4)[1] == 0);
    CHECK((*reference)->notes.back() == "2 values outside [0,1] were clipped");

    for (const float bad : { std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity() }) {
        values[(3 * 20 + 7) * 3 + 2] = bad;
        write(folder.path("b.exr"), spec, values);
        CHECK(refusal(folder.path("b.exr")) == "NaN or infinity at pixel (7, 3)");
    }
}

TEST_CASE("Images that are no reference are refused, each with its own message")
{
    const ScratchFolder folder;
    const std::string exr = folder.path("a.exr");
    OIIO::ImageSpec spec(20, 10, 3, OIIO::TypeUInt32);
    write(exr, spec, std::vector<float>(600, 0.5f));
    CHECK(refusal(exr) == "EXR of uint values: half or float are needed");

    OIIO::ImageSpec grey(20, 10, 1, OIIO::TypeFloat);
    write(exr, grey, std::vector<float>(200, 0.5f));
    CHECK(refusal(exr) == "image without channels R, G, B (it has Y)");

    write(exr, OIIO::ImageSpec(20, 10, 3, OIIO::TypeFloat), std::vector<float>(600, 0.001f));
    CHECK(refusal(exr).find("is a black frame") == 0);

    const std::string tiff = folder.path("a.tif");
    write(tiff, OIIO::ImageSpec(20, 10, 3, OIIO::TypeUInt16), std::vector<float>(600, 0.5f));
    CHECK(refusal(tiff).find("TIFF without srisp's metadata may be display-encoded") == 0);

    for (const auto& [name, type] : { std::pair("jpg", "JPEG"), std::pair("png", "PNG"), std::pair("gif", "GIF"),
                                      std::pair("bmp", "BMP"), std::pair("webp", "WebP") }) {
        const std::string path = folder.path(std::string("a.") + name);
        write(path, OIIO::ImageSpec(20, 10, 3, OIIO::TypeUInt8), std::vector<float>(600, 0.5f));
        CHECK(refusal(path) ==
              std::string("is a ") + type +
                  " file, which is display-encoded and cannot be a reference: give a RAW file (DNG, NEF, CR2, ...)");
        // The content decides, not the name.
        std::filesystem::rename(path, folder.path("renamed.dng"));
        CHECK(refusal(folder.path("renamed.dng")).find(std::string("is a ") + type) == 0);
    }
}

TEST_CASE("What OpenEXR quotes of a damaged file comes into messages as text that can be shown")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeHalf);
    spec.channelnames = { "B", "G", "channel" };
    write(folder.path("a.exr"), spec, ramp(spec));
    std::ifstream file(folder.path("a.exr"), std::ios::binary);
    std::string bytes{ std::istreambuf_iterator<char>(file), {} };
    const std::size_t name = bytes.find("channel", bytes.find("chlist"));
    REQUIRE(name != std::string::npos);
    bytes.replace(name, 7, "\x95\x1b[2J\n\xff");
    for (const char type : { 1, 99 }) { // half; none, which OpenEXR refuses with the name
        bytes[name + 8] = type;
        std::ofstream(folder.path("b.exr"), std::ios::binary) << bytes;
        const std::string message = refusal(folder.path("b.exr"));
        INFO(message);
        CHECK(message != "(it loaded)");
        CHECK(valid_utf8(message) == message);
        CHECK(message.find_first_of("\n\x1b") == std::string::npos);
    }
}

TEST_CASE("Truncated EXR files are errors")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeFloat);
    spec.attribute("compression", "none");
    const std::string path = folder.path("a.exr");
    write(path, spec, ramp(spec));
    const auto size = std::filesystem::file_size(path);
    for (const double part : { 0.9, 0.5, 0.1, 0.004 }) {
        std::filesystem::resize_file(path, std::uintmax_t(double(size) * part));
        CHECK(!load_reference(path));
    }
}

TEST_CASE("What srisp unprocessed is a reference, as EXR and as 16-bit TIFF, upright; what it processed is not")
{
    const ScratchFolder folder;
    for (const std::string name : { "a.exr", "a.tif" }) {
        CAPTURE(name);
        OIIO::ImageSpec spec(40, 30, 3, name == "a.exr" ? OIIO::TypeFloat : OIIO::TypeUInt16);
        spec.attribute("Orientation", 6);
        std::vector<float> values(3600, 0.2f);
        for (int y = 0; y < 30; ++y)
            std::fill_n(values.begin() + y * 120, 60, 0.8f); // left half bright, so upright the top
        write(folder.path(name), result_of(Direction::reverse, spec), values);
        const auto reference = load_reference(folder.path(name));
        REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
        CHECK((*reference)->thumbnail.view().pixel(128, 20)[0] == doctest::Approx(0.8).epsilon(1e-4));
        CHECK((*reference)->thumbnail.view().pixel(128, 230)[0] == doctest::Approx(0.2).epsilon(1e-4));
        CHECK((*reference)->notes.empty());
        const CameraFacts& facts = (*reference)->facts;
        if (name == "a.tif") // keeps no more than the ImageDescription
            continue;
        CHECK(facts.make == "Maker");
        CHECK(facts.as_shot_neutral == std::array<float, 3>{ 0.5f, 1, 0.25f });
        REQUIRE(facts.noise_profile.size() == 6);
        CHECK(facts.noise_profile[5] == doctest::Approx(6e-7));
        REQUIRE(facts.color_matrices.size() == 1);
        CHECK(facts.color_matrices[0].xyz_to_camera == std::array<float, 9>{ 1, 0, 0, 0, 2, 0, 0, 0, 3 });
        CHECK(facts.color_matrices[0].illuminant == 21);
    }
    const OIIO::ImageSpec eight(40, 30, 3, OIIO::TypeUInt8);
    write(folder.path("8.tif"), result_of(Direction::reverse, eight), std::vector<float>(3600, 0.5f));
    CHECK(refusal(folder.path("8.tif")) == "TIFF of uint8 values: 16 bits or float are needed");

    const OIIO::ImageSpec processed(40, 30, 3, OIIO::TypeFloat);
    write(folder.path("f.exr"), result_of(Direction::forward, processed), std::vector<float>(3600, 0.5f));
    CHECK(refusal(folder.path("f.exr")) ==
          "is what srisp made of a RAW-like image, display-encoded and cannot be a reference: give a RAW file");
}

TEST_CASE("A mosaic that srisp wrote as EXR, TIFF or PNG is no reference, and the message says what would be")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec = result_of(Direction::reverse, OIIO::ImageSpec(40, 30, 1, OIIO::TypeUInt16));
    record_sensor_values(spec, { "GRBG", { 0.1f, 0.1f, 0.1f, 0.1f }, 0.9f, {} });
    for (const char* name : { "a.exr", "a.tif", "a.png" }) {
        CAPTURE(std::string(name));
        spec.set_format(std::string(name) == "a.exr" ? OIIO::TypeHalf : OIIO::TypeUInt16);
        write(folder.path(name), spec, ramp(spec));
        CHECK(refusal(folder.path(name)) == "is a mosaic (GRBG) that srisp wrote as an image; write it as a DNG, which "
                                            "can be a reference");
    }
    // Only the line in its description is left.
    OIIO::ImageSpec bare(40, 30, 1, OIIO::TypeUInt16);
    bare.attribute("ImageDescription", spec.get_string_attribute("ImageDescription"));
    write(folder.path("bare.tif"), bare, ramp(bare));
    CHECK(refusal(folder.path("bare.tif")).rfind("is a mosaic (GRBG)", 0) == 0);
}
