// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_converter.h"

#include <cmath>
#include <limits>

#include <lcms2.h>
#include <srisp/metadata.h>

#include "photo/color_management.h"
#include "shared_files.h"

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

std::vector<unsigned char> profile_bytes(cmsHPROFILE profile)
{
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::vector<unsigned char> bytes(size);
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    return bytes;
}

std::vector<unsigned char> adobe_rgb()
{
    const cmsCIExyY white = { 0.3127, 0.3290, 1 };
    const cmsCIExyYTRIPLE primaries = { { 0.64, 0.33, 1 }, { 0.21, 0.71, 1 }, { 0.15, 0.06, 1 } };
    cmsToneCurve* gamma = cmsBuildGamma(nullptr, 2.19921875);
    cmsToneCurve* curves[3] = { gamma, gamma, gamma };
    const auto bytes = profile_bytes(cmsCreateRGBProfile(&white, &primaries, curves));
    cmsFreeToneCurve(gamma);
    return bytes;
}

std::vector<unsigned char> grey_gamma(double gamma)
{
    cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
    const auto bytes = profile_bytes(cmsCreateGrayProfile(cmsD50_xyY(), curve));
    cmsFreeToneCurve(curve);
    return bytes;
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

/// Little CMS in float, all of its precision: what ours must equal.
std::vector<float> lcms_rgb(const std::vector<unsigned char>& icc, std::vector<float> rgb)
{
    cmsHPROFILE from = cmsOpenProfileFromMem(icc.data(), static_cast<cmsUInt32Number>(icc.size()));
    cmsHPROFILE to = cmsCreate_sRGBProfile();
    cmsHTRANSFORM transform =
        cmsCreateTransform(from, TYPE_RGB_FLT, to, TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE);
    cmsDoTransform(transform, rgb.data(), rgb.data(), static_cast<cmsUInt32Number>(rgb.size() / 3));
    cmsDeleteTransform(transform);
    cmsCloseProfile(from);
    cmsCloseProfile(to);
    for (float& value : rgb)
        value = std::min(std::max(value, 0.0f), 1.0f);
    return rgb;
}

void check_against_lcms(const std::vector<unsigned char>& icc)
{
    std::vector<float> grid;
    for (int r = 0; r <= 20; ++r)
        for (int g = 0; g <= 20; ++g)
            for (int b = 0; b <= 20; ++b)
                for (const int v : { r, g, b })
                    grid.push_back(float(v * v) / 400);
    const std::vector<float> expected = lcms_rgb(icc, grid);
    const auto transform = color_transform_from_icc(icc.data(), icc.size(), 3);
    REQUIRE(bool(transform));
    REQUIRE(*transform);
    (*transform)->apply(grid.data(), static_cast<std::int64_t>(grid.size() / 3));
    float worst = 0;
    for (std::size_t i = 0; i < grid.size(); ++i)
        worst = std::max(worst, std::fabs(grid[i] - expected[i]));
    INFO("largest difference " << worst);
    CHECK(worst < 3e-5f);
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

TEST_CASE("the sRGB curve's table is exact to 5e-7")
{
    double worst = 0;
    for (int i = 0; i <= 1000003; ++i) {
        const float v = static_cast<float>(i / 1000003.0);
        worst = std::max(worst, std::fabs(srgb_encoded(v) - srgb(v)));
    }
    INFO("largest difference " << worst);
    CHECK(worst < 5e-7);
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

TEST_CASE("an unknown colour space is told of")
{
    CHECK(converter_of(photo_spec({ "R", "G", "B" }, OIIO::TypeFloat, "ACEScg")).notes().at(0) ==
          "the colour space 'ACEScg' is not known; taken as linear sRGB");
    auto uncalibrated = photo_spec({ "R", "G", "B" });
    uncalibrated.attribute("Exif:ColorSpace", 65535);
    CHECK(converter_of(uncalibrated).notes().size() == 1);
}

TEST_CASE("Adobe RGB becomes sRGB as Little CMS computes it")
{
    check_against_lcms(adobe_rgb());
}

TEST_CASE("a photo in Display P3 becomes sRGB as Little CMS computes it, and out-of-gamut colours are counted")
{
    SKIP_WITHOUT_SHARED("data/fullsize/iphone7_display_p3.jpg");
    auto input = OIIO::ImageInput::open(shared_file("data/fullsize/iphone7_display_p3.jpg"));
    REQUIRE(input);
    const auto* icc = input->spec().find_attribute("ICCProfile");
    REQUIRE(icc);
    const auto* bytes = static_cast<const unsigned char*>(icc->data());
    check_against_lcms({ bytes, bytes + icc->type().size() });
    const auto converter = converter_of(input->spec());
    PhotoCounts counts;
    CHECK(rgb_of(converter, { 0.5f, 0.5f, 0.5f }, &counts)[1] == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(counts.clipped == 0);
    rgb_of(converter, { 1, 0, 0 }, &counts);
    CHECK(counts.clipped > 0);
}

TEST_CASE("a grey profile gives a grey curve")
{
    auto spec = photo_spec({ "Y" });
    embed(spec, grey_gamma(1.0));
    const auto rgb = rgb_of(converter_of(spec), { 0.18f });
    CHECK(rgb[0] == doctest::Approx(srgb(0.18)).epsilon(1e-4));
    CHECK(rgb[0] == rgb[1]);
    CHECK(rgb[0] == rgb[2]);
}

TEST_CASE("a profile that is sRGB itself is skipped")
{
    const auto icc = profile_bytes(cmsCreate_sRGBProfile());
    const auto transform = color_transform_from_icc(icc.data(), icc.size(), 3);
    REQUIRE(bool(transform));
    CHECK(*transform == nullptr);
}

TEST_CASE("damaged and unfitting profiles are errors, which input=srgb passes over")
{
    auto damaged = photo_spec({ "R", "G", "B" });
    embed(damaged, std::vector<unsigned char>(200, 7));
    CHECK(refusal(damaged) == "photo: its ICC profile of 200 bytes is damaged; input=srgb ignores it");
    CHECK(rgb_of(converter_of(damaged, InputEncoding::srgb), { 0.5f, 0, 1 })[0] == 0.5f);
    auto grey = photo_spec({ "R", "G", "B" });
    embed(grey, grey_gamma(2.2));
    CHECK(refusal(grey).find("its ICC profile is for GRAY, the image has RGB channels") != std::string::npos);
    auto truncated = photo_spec({ "R", "G", "B" });
    auto icc = adobe_rgb();
    icc.resize(200);
    embed(truncated, icc);
    CHECK(refusal(truncated).find("ICC profile") != std::string::npos);
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
