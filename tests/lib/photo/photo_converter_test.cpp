// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_converter.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <srisp/metadata.h>

#include "container/file_description.h"
#include "icc_profiles.h"

using namespace srisp;

namespace {

OIIO::ImageSpec photo_spec(std::vector<std::string> channels, OIIO::TypeDesc type = OIIO::TypeUInt8,
                           const char* space = "sRGB")
{
    OIIO::ImageSpec spec(4, 2, static_cast<int>(channels.size()), type);
    spec.channelnames = channels;
    spec.alpha_channel = -1;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c] == "A")
            spec.alpha_channel = static_cast<int>(c);
        if (channels[c] == "Z")
            spec.z_channel = static_cast<int>(c);
    }
    spec.attribute("oiio:ColorSpace", space);
    return spec;
}

void embed(OIIO::ImageSpec& spec, const std::vector<unsigned char>& icc)
{
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(icc.size())), icc.data());
}

double srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

PhotoConverter converter_of(const OIIO::ImageSpec& spec, InputEncoding encoding = InputEncoding::automatic)
{
    auto converter = PhotoConverter::create(spec, encoding, "photo");
    REQUIRE_MESSAGE(bool(converter), converter.error().message);
    return std::move(*converter);
}

std::string refusal(const OIIO::ImageSpec& spec, InputEncoding encoding = InputEncoding::automatic)
{
    const auto converter = PhotoConverter::create(spec, encoding, "photo");
    REQUIRE(!converter);
    return converter.error().message;
}

std::vector<float> rgb_of(const PhotoConverter& converter, std::vector<float> pixel, PhotoCounts* counts = nullptr)
{
    std::vector<float> rgb(3);
    PhotoCounts local;
    converter.to_rgb(pixel.data(), 1, rgb.data(), counts ? *counts : local);
    return rgb;
}

} // namespace

TEST_CASE("display-encoded RGB goes through to the bit")
{
    const auto converter = converter_of(photo_spec({ "R", "G", "B" }));
    CHECK(rgb_of(converter, { 0.25f, 0.5f, 1.0f }) == std::vector<float>{ 0.25f, 0.5f, 1.0f });
    CHECK(converter.output_spec().format == OIIO::TypeFloat);
    CHECK(converter.notes().empty());
}

TEST_CASE("colour is found by name, whatever its order")
{
    const auto converter = converter_of(photo_spec({ "A", "B", "G", "R" }));
    CHECK(rgb_of(converter, { 1, 0.1f, 0.2f, 0.3f }) == std::vector<float>{ 0.3f, 0.2f, 0.1f });
}

TEST_CASE("grey becomes three equal channels, and three in the result")
{
    const auto converter = converter_of(photo_spec({ "Y" }));
    CHECK(rgb_of(converter, { 0.5f }) == std::vector<float>{ 0.5f, 0.5f, 0.5f });
    CHECK(converter.output_spec().channelnames == std::vector<std::string>{ "R", "G", "B" });
}

TEST_CASE("associated alpha is divided out before and multiplied in after")
{
    const auto converter = converter_of(photo_spec({ "R", "G", "B", "A" }));
    const std::vector<float> stored = { 0.25f, 0.125f, 0.5f, 0.5f };
    CHECK(rgb_of(converter, stored) == std::vector<float>{ 0.5f, 0.25f, 1.0f });
    const std::vector<float> processed = { 0.1f, 0.2f, 0.3f };
    std::vector<float> out(4);
    converter.from_rgb(processed.data(), stored.data(), 1, true, out.data());
    CHECK(out == std::vector<float>{ 0.05f, 0.1f, 0.15f, 0.5f });
    converter.from_rgb(processed.data(), stored.data(), 1, false, out.data());
    CHECK(out == std::vector<float>{ 0.1f, 0.2f, 0.3f, 0.5f });
}

TEST_CASE("straight colour is not divided, also where nothing is opaque")
{
    auto spec = photo_spec({ "R", "G", "B", "A" });
    spec.attribute("oiio:UnassociatedAlpha", 1);
    const auto converter = converter_of(spec);
    const std::vector<float> stored = { 0.25f, 0.5f, 0.75f, 0 };
    CHECK(rgb_of(converter, stored) == std::vector<float>{ 0.25f, 0.5f, 0.75f });
    const std::vector<float> processed = { 0.1f, 0.2f, 0.3f };
    std::vector<float> out(4);
    converter.from_rgb(processed.data(), stored.data(), 1, true, out.data());
    CHECK(out == std::vector<float>{ 0, 0, 0, 0 });
}

TEST_CASE("in associated images empty stays black and added light stays")
{
    const auto converter = converter_of(photo_spec({ "R", "G", "B", "A" }, OIIO::TypeFloat));
    const std::vector<float> processed = { 0.1f, 0.2f, 0.3f };
    std::vector<float> out(4);
    const std::vector<float> empty = { 0, 0, 0, 0 }, fire = { 0.5f, 0, 0, 0 };
    converter.from_rgb(processed.data(), empty.data(), 1, true, out.data());
    CHECK(out == std::vector<float>{ 0, 0, 0, 0 });
    converter.from_rgb(processed.data(), fire.data(), 1, true, out.data());
    CHECK(out == std::vector<float>{ 0.1f, 0.2f, 0.3f, 0 });
}

TEST_CASE("other channels are carried through as they are")
{
    const auto converter = converter_of(photo_spec({ "R", "G", "B", "A", "Z", "mask" }, OIIO::TypeFloat));
    const auto& spec = converter.output_spec();
    CHECK(spec.channelnames == std::vector<std::string>{ "R", "G", "B", "A", "Z", "mask" });
    CHECK(spec.alpha_channel == 3);
    CHECK(spec.z_channel == 4);
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> stored = { 0.5f, 0.5f, 0.5f, 1, inf, -3 }, processed = { 0.1f, 0.2f, 0.3f };
    std::vector<float> out(6);
    converter.from_rgb(processed.data(), stored.data(), 1, true, out.data());
    CHECK(out == std::vector<float>{ 0.1f, 0.2f, 0.3f, 1, inf, -3 });
}

TEST_CASE("linear images are encoded with the sRGB curve")
{
    const auto linear = converter_of(photo_spec({ "R", "G", "B" }, OIIO::TypeFloat, "Linear"));
    const auto rgb = rgb_of(linear, { 0.001f, 0.18f, 0.9f });
    CHECK(rgb[0] == doctest::Approx(srgb(0.001)).epsilon(1e-5));
    CHECK(rgb[1] == doctest::Approx(srgb(0.18)).epsilon(1e-6));
    CHECK(rgb[2] == doctest::Approx(srgb(0.9)).epsilon(1e-6));
    const auto forced = converter_of(photo_spec({ "R", "G", "B" }), InputEncoding::linear);
    CHECK(rgb_of(forced, { 0.18f, 0, 0 })[0] == rgb[1]);
    const auto kept = converter_of(photo_spec({ "R", "G", "B" }, OIIO::TypeFloat, "Linear"), InputEncoding::srgb);
    CHECK(rgb_of(kept, { 0.18f, 0, 0 })[0] == 0.18f);
}

TEST_CASE("values outside the range are clipped, those that are no numbers become 0, both are counted")
{
    const auto converter = converter_of(photo_spec({ "R", "G", "B" }, OIIO::TypeFloat, "Linear"));
    PhotoCounts counts;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    CHECK(rgb_of(converter, { 7, -1, nan }, &counts) == std::vector<float>{ 1, 0, 0 });
    CHECK(rgb_of(converter, { inf, -inf, 0 }, &counts) == std::vector<float>{ 1, 0, 0 });
    CHECK(counts.values == 6);
    CHECK(counts.clipped == 4);
    CHECK(counts.replaced == 1);
}

TEST_CASE("the notes of the file and of its colour are the photo's, and input=srgb passes over what the image says")
{
    auto spec = photo_spec({ "R", "G", "B" });
    embed(spec, std::vector<unsigned char>(200, 7));
    add_note(spec, "is an animation; its first frame was taken");
    const auto converter = converter_of(spec);
    CHECK(converter.notes() ==
          std::vector<std::string>{
              "is an animation; its first frame was taken",
              "its ICC profile of 200 bytes is damaged: it does not say that it is one; it was ignored" });
    CHECK(note_list(converter.output_spec()).empty());
    CHECK(rgb_of(converter, { 0.5f, 0, 1 }) == std::vector<float>{ 0.5f, 0, 1 });
    auto adobe = photo_spec({ "R", "G", "B" });
    embed(adobe, adobe_rgb());
    CHECK(rgb_of(converter_of(adobe, InputEncoding::srgb), { 0.5f, 0, 1 })[0] == 0.5f);
    CHECK(rgb_of(converter_of(adobe), { 0.5f, 0, 1 })[0] != 0.5f);
}

TEST_CASE("unbounded colours of wide linear spaces are clipped in sRGB and counted")
{
    auto spec = photo_spec({ "R", "G", "B" }, OIIO::TypeFloat, "Linear");
    const float rec2020[8] = { 0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f };
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec2020);
    const auto converter = converter_of(spec);
    PhotoCounts counts;
    // Red of BT.2020 is (1.6605, −0.1246, −0.0182) in linear sRGB [ITU-R BT.2087].
    CHECK(rgb_of(converter, { 1, 0, 0 }, &counts) == std::vector<float>{ 1, 0, 0 });
    CHECK(counts.clipped == 3);
    const auto dim = rgb_of(converter, { 0.3f, 0.2f, 0.1f }, &counts);
    CHECK(dim[0] == doctest::Approx(srgb(0.3 * 1.6605 - 0.2 * 0.5876 - 0.1 * 0.0728)).epsilon(2e-4));
    CHECK(dim[1] == doctest::Approx(srgb(-0.3 * 0.1246 + 0.2 * 1.1329 - 0.1 * 0.0083)).epsilon(2e-4));
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    CHECK(rgb_of(converter, { nan, nan, nan }, &counts) == std::vector<float>{ 0, 0, 0 });
    CHECK(rgb_of(converter, { inf, inf, inf }, &counts) == std::vector<float>{ 1, 1, 1 });
    CHECK(counts.replaced == 3);
    // An image that was made sRGB's keeps the attribute of what it was.
    spec.attribute("oiio:ColorSpace", "lin_srgb");
    CHECK(rgb_of(converter_of(spec), { 1, 0, 0 }) == std::vector<float>{ 1, 0, 0 });
    CHECK(rgb_of(converter_of(spec), { 0.2f, 0.2f, 0 })[0] == doctest::Approx(srgb(0.2)).epsilon(1e-5));
}

TEST_CASE("images that are no photos are refused by name")
{
    auto converted = photo_spec({ "R", "G", "B" });
    converted.attribute("jpeg:ColorSpace", "CMYK");
    CHECK(refusal(converted) == "photo: is a CMYK image; convert it to RGB first");
    auto tiff = photo_spec({ "R", "G", "B" });
    tiff.attribute("tiff:PhotometricInterpretation", 5);
    CHECK(refusal(tiff).find("CMYK") != std::string::npos);
    CHECK(refusal(photo_spec({ "C", "M", "Y", "K" })).find("CMYK") != std::string::npos);
    CHECK(refusal(photo_spec({ "Y", "RY", "BY" })) ==
          "photo: has the channels Y, RY, BY; a photo needs R, G, B or one grey channel");
    CHECK(refusal(photo_spec({ "Z" })).find("has the channels Z") != std::string::npos);
    auto deep = photo_spec({ "R", "G", "B" }, OIIO::TypeFloat);
    deep.deep = true;
    CHECK(refusal(deep).find("deep") != std::string::npos);
    auto volume = photo_spec({ "R", "G", "B" }, OIIO::TypeFloat);
    volume.depth = 5;
    CHECK(refusal(volume).find("5 slices") != std::string::npos);
    auto raw_like = photo_spec({ "R", "G", "B" }, OIIO::TypeFloat);
    mark_result(raw_like, Direction::reverse);
    CHECK(refusal(raw_like).find("RAW-like image already") != std::string::npos);
    CHECK(bool(PhotoConverter::create(raw_like, InputEncoding::camera, "photo")));
}
