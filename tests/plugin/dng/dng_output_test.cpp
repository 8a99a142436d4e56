// SPDX-License-Identifier: Apache-2.0
#include "dng_output.h"

#include <cmath>
#include <filesystem>

#include <doctest/doctest.h>
#include <srisp/metadata.h>

#include "color/color_transform.h"
#include "lib/dng/made_dng.h"
#include "record/record.h"

using namespace srisp;
using namespace srisp::plugin;

namespace {

constexpr int kWidth = 40, kHeight = 30;

/// A RAW-like result of a camera with levels of its own.
OIIO::ImageSpec result_spec(int channels)
{
    OIIO::ImageSpec spec(kWidth, kHeight, channels, OIIO::TypeFloat);
    CameraFacts facts;
    facts.make = "Maker";
    facts.model = "Model 5";
    facts.cfa_pattern = "GBRG";
    facts.black_level = { 512, 513, 514, 515 };
    facts.white_level = 16383;
    facts.iso = 400;
    facts.as_shot_neutral = { 0.6f, 1, 0.4f };
    facts.color_matrices = { { { 0.9f, -0.2f, -0.1f, -0.4f, 1.2f, 0.2f, -0.1f, 0.2f, 0.6f }, 17 },
                             { { 0.7f, -0.1f, -0.1f, -0.4f, 1.3f, 0.2f, -0.1f, 0.2f, 0.6f }, 21 } };
    Parameters parameters;
    parameters.white_balance = { 2, 1, 1.6f };
    parameters.reference_name = "ref & co.dng";
    record_result(spec, parameters, &facts, Direction::reverse);
    spec.attribute("Orientation", 6);
    spec.attribute("Copyright", "Somebody");
    return spec;
}

OIIO::ImageSpec mosaic_spec(const std::string& pattern = "GBRG")
{
    OIIO::ImageSpec spec = result_spec(1);
    SensorValues values;
    values.cfa_pattern = pattern;
    record_sensor_values(spec, values);
    return spec;
}

std::vector<float> ramp(const OIIO::ImageSpec& spec)
{
    std::vector<float> pixels(spec.image_pixels() * std::size_t(spec.nchannels));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = float(i % 997) / 1000;
    return pixels;
}

int sample(const RawImage& raw, int x, int y, int channel = 0)
{
    return raw.pixels.shorts[y * raw.pixels.row_stride + x * raw.pixels.pixel_stride + channel];
}

/// "": written.
std::string write(const std::string& path, const OIIO::ImageSpec& spec, const std::vector<float>& pixels)
{
    DngOutput output;
    const bool written = output.open(path, spec, OIIO::ImageOutput::Create) &&
                         output.write_image(OIIO::TypeFloat, pixels.data()) && output.close();
    return written ? "" : output.geterror();
}

std::string error_of(const ScratchFolder& folder, const OIIO::ImageSpec& spec)
{
    const std::string path = folder.path("refused.dng");
    std::string error = write(path, spec, ramp(spec));
    CHECK(!std::filesystem::exists(path));
    const std::string name = "DNG '" + path + "': ";
    return error.compare(0, name.size(), name) == 0 ? error.substr(name.size()) : "without a name: " + error;
}

} // namespace

TEST_CASE("a mosaic becomes the reference's codes, with its levels, matrices and phase, and the scene's neutral")
{
    const ScratchFolder folder;
    const OIIO::ImageSpec spec = mosaic_spec();
    const std::vector<float> pixels = ramp(spec);
    REQUIRE(write(folder.path("a.dng"), spec, pixels) == "");
    const RawImage raw = decoded(folder.path("a.dng"));
    const CameraFacts& facts = raw.facts;
    CHECK(facts.cfa_pattern == "GBRG");
    CHECK(facts.black_level == std::array<float, 4>{ 512, 513, 514, 515 });
    CHECK(facts.white_level == 16383);
    CHECK(facts.make == "Maker");
    CHECK(facts.model == "Model 5");
    CHECK(facts.iso == 400);
    CHECK(facts.orientation == 6);
    REQUIRE(facts.color_matrices.size() == 2);
    CHECK(facts.as_shot_neutral[0] == doctest::Approx(0.5)); // not the reference's 0.6
    CHECK(facts.as_shot_neutral[2] == doctest::Approx(1 / 1.6));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float black[2][2] = { { 513, 514 }, { 512, 515 } }; // G B, R G
            const float b = black[y & 1][x & 1];
            const float expected = std::round(b + pixels[std::size_t(y * kWidth + x)] * (16383 - b));
            CHECK(sample(raw, x, y) == expected);
        }
}

TEST_CASE("a mosaic in the camera's levels comes out to the code")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec = mosaic_spec("RGGB");
    SensorValues values = recorded_sensor_values(spec);
    values.black_level = { 512 / 65535.0f, 513 / 65535.0f, 514 / 65535.0f, 515 / 65535.0f };
    values.white_level = 16383 / 65535.0f;
    record_sensor_values(spec, values);
    std::vector<float> pixels(std::size_t(kWidth) * kHeight);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = float(i * 13) / 65535;
    REQUIRE(write(folder.path("a.dng"), spec, pixels) == "");
    const RawImage raw = decoded(folder.path("a.dng"));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        CHECK(sample(raw, int(i) % kWidth, int(i) / kWidth) == std::min(int(i) * 13, 16383));
}

TEST_CASE("noise below black survives, and its profile goes into the file")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec = mosaic_spec();
    SensorValues values = recorded_sensor_values(spec);
    values.noise_profile = { 0.01, 1e-4, 0.02, 1e-4, 0.03, 1e-4 };
    record_sensor_values(spec, values);
    REQUIRE(write(folder.path("a.dng"), spec, std::vector<float>(std::size_t(kWidth) * kHeight, -0.01f)) == "");
    const RawImage raw = decoded(folder.path("a.dng"));
    CHECK(sample(raw, 0, 0) == std::round(513 - 0.01 * (16383 - 513)));
    REQUIRE(raw.facts.noise_profile.size() == 6);
    CHECK(raw.facts.noise_profile[4] == doctest::Approx(0.03));
}

TEST_CASE("the phase counts from pixel (0, 0), wherever the data window begins")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec = mosaic_spec("RGGB");
    spec.x = 3;
    spec.y = 1;
    REQUIRE(write(folder.path("a.dng"), spec, ramp(spec)) == "");
    CHECK(decoded(folder.path("a.dng")).facts.cfa_pattern == "BGGR");
}

TEST_CASE("three channels become LinearRaw of 16 bits, with black 0")
{
    const ScratchFolder folder;
    const OIIO::ImageSpec spec = result_spec(3);
    const std::vector<float> pixels = ramp(spec);
    REQUIRE(write(folder.path("a.dng"), spec, pixels) == "");
    const RawImage raw = decoded(folder.path("a.dng"));
    REQUIRE(raw.pixels.channels == 3);
    CHECK(raw.facts.white_level == 65535);
    CHECK(raw.facts.black_level[0] == 0);
    for (int i = 0; i < kWidth * kHeight * 3; ++i)
        CHECK(sample(raw, i / 3 % kWidth, i / 3 / kWidth, i % 3) == std::round(pixels[std::size_t(i)] * 65535));
}

TEST_CASE("bits, layout, compression and floats are attributes")
{
    const ScratchFolder folder;
    const auto facts_with = [&](const std::string& name, const std::string& value, int channels) {
        OIIO::ImageSpec spec = channels == 1 ? mosaic_spec() : result_spec(channels);
        spec.attribute(name, value);
        CHECK(write(folder.path("a.dng"), spec, ramp(spec)) == "");
        return decoded(folder.path("a.dng"));
    };
    CHECK(facts_with("dng:bits", "12", 1).facts.white_level == 4095); // scaled: the reference needs 14
    CHECK(facts_with("dng:bits", "12", 1).facts.black_level[0] == doctest::Approx(512 * 4095 / 16383.0));
    CHECK(facts_with("dng:bits", "15", 1).facts.white_level == 16383);
    CHECK(facts_with("dng:bits", "10", 3).facts.white_level == 1023);
    CHECK(facts_with("dng:layout", "cinema", 1).facts.white_level == 16383);
    CHECK(facts_with("dng:datatype", "float", 3).pixels.floats);
    CHECK(facts_with("compression", "zips", 1).pixels.shorts); // what an EXR brought
    const auto size_with = [&](const std::string& compression) {
        facts_with("compression", compression, 1);
        return std::filesystem::file_size(folder.path("a.dng"));
    };
    CHECK(size_with("none") != size_with("lossless"));
    OIIO::ImageSpec spec = mosaic_spec();
    spec.attribute("oiio:BitsPerSample", 12);
    REQUIRE(write(folder.path("a.dng"), spec, ramp(spec)) == "");
    CHECK(decoded(folder.path("a.dng")).facts.white_level == 4095);
}

TEST_CASE("record, mark and photographer are in the file")
{
    const ScratchFolder folder;
    const OIIO::ImageSpec spec = mosaic_spec();
    REQUIRE(write(folder.path("a.dng"), spec, ramp(spec)) == "");
    const FileBytes bytes = read_file(folder.path("a.dng"));
    const std::string text(reinterpret_cast<const char*>(bytes.data.get()), bytes.size);
    CHECK(text.find(spec.get_string_attribute("ImageDescription")) != std::string::npos);
    CHECK(text.find("digitalsourcetype/algorithmicallyEnhanced") != std::string::npos);
    CHECK(text.find("are those of the reference ref &amp; co.dng") != std::string::npos);
    CHECK(text.find("Somebody") != std::string::npos);
}

TEST_CASE("a picture that was never unprocessed becomes the light that it shows")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec(kWidth, kHeight, 3, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    const std::vector<float> pixels = ramp(spec);
    REQUIRE(write(folder.path("a.dng"), spec, pixels) == "");
    const RawImage raw = decoded(folder.path("a.dng"));
    CHECK(raw.facts.as_shot_neutral == std::array<float, 3>{ 1, 1, 1 });
    CHECK(sample(raw, 166 % kWidth, 166 / kWidth, 2) == std::round(srgb_decoded(pixels[500]) * 65535));
    REQUIRE(raw.facts.color_matrices.size() == 1);
    CHECK(raw.facts.color_matrices[0].xyz_to_camera[0] == doctest::Approx(3.2406).epsilon(1e-3));

    OIIO::ImageSpec linear(kWidth, kHeight, 3, OIIO::TypeFloat);
    REQUIRE(write(folder.path("b.dng"), linear, pixels) == "");
    CHECK(std::abs(sample(decoded(folder.path("b.dng")), 166 % kWidth, 166 / kWidth, 2) - pixels[500] * 65535) < 2);
}

TEST_CASE("levels of a reference of floats are not codes of a file of integers")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec = mosaic_spec();
    CameraFacts facts;
    facts.white_level = 1;
    facts.black_level = {};
    write_camera(spec, facts);
    REQUIRE(write(folder.path("a.dng"), spec, ramp(spec)) == "");
    const RawImage raw = decoded(folder.path("a.dng"));
    CHECK(raw.facts.white_level == 65535);
    CHECK(raw.pixels.shorts[39] == std::round(0.039 * 65535));
}

TEST_CASE("the file is there when the last row is, whatever the host makes of close")
{
    const ScratchFolder folder;
    const OIIO::ImageSpec spec = mosaic_spec();
    std::vector<float> pixels = ramp(spec);
    DngOutput output;
    REQUIRE(output.open(folder.path("a.dng"), spec, OIIO::ImageOutput::Create));
    REQUIRE(output.write_image(OIIO::TypeFloat, pixels.data()));
    CHECK(decoded(folder.path("a.dng")).pixels.height == kHeight);
    pixels[0] = 0.5f; // a row again
    REQUIRE(output.write_scanline(0, 0, OIIO::TypeFloat, pixels.data(), OIIO::AutoStride));
    REQUIRE(output.close());
    CHECK(decoded(folder.path("a.dng")).pixels.shorts[0] == std::round(513 + 0.5 * (16383 - 513)));

    REQUIRE(output.open("/nowhere/a.dng", spec, OIIO::ImageOutput::Create));
    CHECK(!output.write_image(OIIO::TypeFloat, pixels.data()));
    CHECK(output.geterror().find("No such file or directory") != std::string::npos);
}

TEST_CASE("the file is the data window: a crop keeps its size, and hosts fill nothing up")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec = mosaic_spec("RGGB");
    spec.x = -3;
    spec.y = 2;
    spec.full_width = 400;
    spec.full_height = 300;
    REQUIRE(write(folder.path("a.dng"), spec, ramp(spec)) == "");
    const RawImage raw = decoded(folder.path("a.dng"));
    CHECK(raw.pixels.width == kWidth);
    CHECK(raw.facts.cfa_pattern == "GRBG");
    const DngOutput output;
    CHECK(output.supports("displaywindow"));
    CHECK(output.supports("negativeorigin"));
    for (const char* feature : { "alpha", "nchannels", "tiles", "multiimage", "mipmap", "deepdata", "volumes" })
        CHECK(!output.supports(feature));
}

TEST_CASE("rows may come in any order, but all must come")
{
    const ScratchFolder folder;
    const OIIO::ImageSpec spec = mosaic_spec();
    const std::vector<float> pixels = ramp(spec);
    {
        DngOutput output;
        REQUIRE(output.open(folder.path("a.dng"), spec, OIIO::ImageOutput::Create));
        for (int y = kHeight - 1; y >= 0; --y)
            REQUIRE(output.write_scanline(y, 0, OIIO::TypeFloat, &pixels[std::size_t(y) * kWidth], OIIO::AutoStride));
        REQUIRE(output.close());
    }
    CHECK(decoded(folder.path("a.dng")).pixels.height == kHeight);
    DngOutput output;
    REQUIRE(output.open(folder.path("b.dng"), spec, OIIO::ImageOutput::Create));
    REQUIRE(output.write_scanline(0, 0, OIIO::TypeFloat, pixels.data(), OIIO::AutoStride));
    CHECK(!output.close());
    CHECK(output.geterror() == "DNG '" + folder.path("b.dng") + "': 29 of 30 rows were never written");
    CHECK(!std::filesystem::exists(folder.path("b.dng")));
}

TEST_CASE("what no DNG can be is refused with one message, and no file")
{
    const ScratchFolder folder;
    const auto with = [](OIIO::ImageSpec spec, const std::string& name, const std::string& value) {
        spec.attribute(name, value);
        return spec;
    };
    const auto sized = [](int width, int height) {
        OIIO::ImageSpec spec = mosaic_spec();
        spec.width = width;
        spec.height = height;
        return spec;
    };
    CHECK(error_of(folder, result_spec(2)) ==
          "image of 2 channels: a DNG has 1 (a mosaic) or 3 (R, G, B; --ch R,G,B leaves others out)");
    CHECK(error_of(folder, result_spec(4)).find("image of 4 channels") == 0);
    CHECK(error_of(folder, result_spec(1)).find("'unprocess:cfa_pattern' must say") != std::string::npos);
    CHECK(error_of(folder, mosaic_spec("RGBE")).find("unknown phase 'RGBE'") == 0);
    CHECK(error_of(folder, sized(65536, 4)) == "image of 65536 x 4 pixels: from 2 to 65535 a side are possible");
    CHECK(error_of(folder, sized(1, 4)).find("image of 1 x 4 pixels") == 0);
    CHECK(error_of(folder, with(mosaic_spec(), "dng:layout", "cinemas")) ==
          "unknown dng:layout 'cinemas'; did you mean 'cinema'?");
    CHECK(error_of(folder, with(mosaic_spec(), "dng:layuot", "cinema")).find("unknown attribute 'dng:layuot'") == 0);
    CHECK(error_of(folder, with(mosaic_spec(), "compression", "losless")) ==
          "unknown compression 'losless'; did you mean 'lossless'?");
    CHECK(error_of(folder, with(mosaic_spec(), "compression", "deflate")).find("'deflate' is for floats") !=
          std::string::npos);
    CHECK(error_of(folder, with(mosaic_spec(), "dng:bits", "9")) == "dng:bits '9': from 10 to 16 are possible");
    CHECK(error_of(folder, with(mosaic_spec(), "dng:datatype", "half")) ==
          "a mosaic has integers; half and float are for three channels");
    OIIO::ImageSpec deep = mosaic_spec();
    deep.deep = true;
    CHECK(error_of(folder, deep) == "a deep image cannot be a RAW file; flatten it first");
    OIIO::ImageSpec levels = mosaic_spec();
    SensorValues values = recorded_sensor_values(levels);
    values.black_level.fill(0.5f);
    values.white_level = 0.5f;
    record_sensor_values(levels, values);
    CHECK(error_of(folder, levels) == "black level 0.5 is not below white level 0.5");

    const OIIO::ImageSpec spec = mosaic_spec();
    std::vector<float> pixels = ramp(spec);
    pixels[kWidth * 2 + 5] = NAN;
    const std::string path = folder.path("nan.dng");
    CHECK(write(path, spec, pixels) == "DNG '" + path + "': value nan of pixel (5, 2): a DNG needs finite ones");
    CHECK(!std::filesystem::exists(path));
    CHECK(write("/nowhere/a.dng", spec, ramp(spec)).find("No such file or directory") != std::string::npos);
}
