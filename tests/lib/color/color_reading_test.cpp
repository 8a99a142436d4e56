// SPDX-License-Identifier: Apache-2.0
#include "color/color_reading.h"

#include <cmath>

#include <doctest/doctest.h>

#include "container/file_description.h"
#include "icc_profiles.h"

using namespace srisp;

namespace {

OIIO::ImageSpec image(OIIO::TypeDesc type, const char* space = nullptr)
{
    OIIO::ImageSpec spec(4, 2, 3, type);
    if (space)
        spec.attribute("oiio:ColorSpace", space);
    return spec;
}

/// What a stored colour is in display-encoded sRGB.
std::vector<double> read(const OIIO::ImageSpec& spec, std::vector<float> rgb)
{
    const ColorReading reading = read_as_described(spec, 3);
    if (reading.transform)
        reading.transform->apply(rgb.data(), 1);
    return { rgb.begin(), rgb.end() };
}

/// What a stored grey is; its colour must stay neutral.
double read_grey(const OIIO::ImageSpec& spec, float grey)
{
    const auto rgb = read(spec, { grey, grey, grey });
    CHECK(rgb[0] == doctest::Approx(rgb[1]).epsilon(1e-5));
    CHECK(rgb[2] == doctest::Approx(rgb[1]).epsilon(1e-5));
    return rgb[1];
}

double srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

} // namespace

TEST_CASE("integers that nothing names are sRGB, floats linear")
{
    CHECK(!read_as_described(image(OIIO::TypeUInt8), 3).transform);
    CHECK(read_grey(image(OIIO::TypeFloat), 0.18f) == doctest::Approx(srgb(0.18)).epsilon(1e-5));
    CHECK(read_as_described(image(OIIO::TypeFloat), 3).notes.empty());
}

TEST_CASE("a name says the curve, whatever the type")
{
    for (const char* name : { "sRGB", "Rec709", "Gamma2.2", "g22_rec709", "srgb_texture" })
        CHECK(!read_as_described(image(OIIO::TypeFloat, name), 3).transform);
    for (const char* name : { "Linear", "lin_srgb", "lin_rec709", "scene_linear" })
        CHECK(read_grey(image(OIIO::TypeUInt16, name), 0.18f) == doctest::Approx(srgb(0.18)).epsilon(1e-5));
    for (const double gamma : { 1.4, 1.8, 2.6 }) {
        const std::string name = "Gamma" + std::to_string(gamma).substr(0, 3);
        const double expected = srgb(std::pow(0.5, gamma));
        CHECK(read_grey(image(OIIO::TypeUInt8, name.c_str()), 0.5f) == doctest::Approx(expected).epsilon(1e-4));
    }
}

TEST_CASE("an unknown name is told of")
{
    CHECK(read_as_described(image(OIIO::TypeFloat, "KodakLog"), 3).notes.at(0) ==
          "the colour space 'KodakLog' is not known; taken as linear sRGB");
    CHECK(read_as_described(image(OIIO::TypeUInt8, "Gamma0"), 3).notes.at(0) ==
          "the colour space 'Gamma0' is not known; taken as display-encoded sRGB");
    auto uncalibrated = image(OIIO::TypeUInt8, "sRGB");
    uncalibrated.attribute("Exif:ColorSpace", 65535);
    CHECK(read_as_described(uncalibrated, 3).notes.size() == 1);
}

TEST_CASE("primaries beside a curve are converted, white to white")
{
    auto spec = image(OIIO::TypeUInt8);
    set_gamma(spec, 563 / 256.0);
    set_chromaticities(spec, { 0.64f, 0.33f, 0.21f, 0.71f, 0.15f, 0.06f, 0.3127f, 0.3290f });
    auto profile = image(OIIO::TypeUInt8, "sRGB");
    const auto icc = adobe_rgb();
    set_icc_profile(profile, icc.data(), icc.size());
    for (const std::vector<float>& color : { std::vector<float>{ 0.6f, 0.4f, 0.3f }, { 0.3f, 0.5f, 0.45f } }) {
        const auto by_numbers = read(spec, color), by_profile = read(profile, color);
        for (int c = 0; c < 3; ++c)
            CHECK(by_numbers[c] == doctest::Approx(by_profile[c]).epsilon(5e-4)); // a profile has 16-bit numbers
    }
    CHECK(read_grey(spec, 1) == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("primaries of another white keep white")
{
    auto spec = image(OIIO::TypeHalf, "Linear");
    set_chromaticities(spec, { 0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f });
    CHECK(read_grey(spec, 0.18f) == doctest::Approx(srgb(0.18)).epsilon(1e-4));
    // AP0 (0.3, 0.2, 0.1) in linear sRGB, by the matrix of the ACES configuration.
    const auto rgb = read(spec, { 0.3f, 0.2f, 0.1f });
    CHECK(rgb[0] == doctest::Approx(srgb(2.52169 * 0.3 - 1.13413 * 0.2 - 0.38756 * 0.1)).epsilon(1e-3));
    CHECK(rgb[1] == doctest::Approx(srgb(-0.27648 * 0.3 + 1.37272 * 0.2 - 0.09624 * 0.1)).epsilon(1e-3));
    CHECK(rgb[2] == doctest::Approx(srgb(-0.01538 * 0.3 - 0.15298 * 0.2 + 1.16835 * 0.1)).epsilon(1e-3));
    CHECK(read(image(OIIO::TypeHalf, "ACES2065-1"), { 0.3f, 0.2f, 0.1f }) == rgb);
}

TEST_CASE("primaries that are none are passed over with a note")
{
    auto spec = image(OIIO::TypeFloat, "Linear");
    for (const float bad : { 0.0f, NAN, 1e30f }) {
        set_chromaticities(spec, { bad, bad, bad, bad, bad, bad, bad, bad });
        CHECK(read_as_described(spec, 3).notes.at(0) ==
              "its chromaticities are not those of a colour space; taken as sRGB's");
        CHECK(read(spec, { 0.2f, 0.1f, 0 })[0] == doctest::Approx(srgb(0.2)).epsilon(1e-5));
    }
}

TEST_CASE("CICP numbers hold before a name, and are those of ITU-T H.273")
{
    auto p3 = image(OIIO::TypeUInt8);
    set_cicp(p3, { 12, 13, 0, 1 });
    // Display P3's red (0.5 encoded) lies outside sRGB: by the published matrix (1.2249, −0.0421, −0.0196).
    const double linear = std::pow((0.5 + 0.055) / 1.055, 2.4);
    CHECK(read(p3, { 0.5f, 0, 0 })[0] == doctest::Approx(srgb(1.2249 * linear)).epsilon(2e-4));
    CHECK(read(p3, { 0.5f, 0, 0 })[1] == 0);
    auto unspecified = image(OIIO::TypeUInt8);
    set_cicp(unspecified, { 2, 2, 2, 1 });
    CHECK(!read_as_described(unspecified, 3).transform);
    CHECK(read_as_described(unspecified, 3).notes.empty());
    auto srgb_numbers = image(OIIO::TypeUInt8);
    set_cicp(srgb_numbers, { 1, 13, 6, 1 });
    CHECK(!read_as_described(srgb_numbers, 3).transform);
    auto unknown = image(OIIO::TypeUInt8);
    set_cicp(unknown, { 77, 99, 0, 1 });
    CHECK(read_as_described(unknown, 3).notes.size() == 2);
}

TEST_CASE("HDR is taken with its reference white at 1, and a note says so")
{
    auto pq = image(OIIO::TypeUInt16);
    set_cicp(pq, { 9, 16, 0, 1 });
    // 203 cd/m² is 0.5807 in PQ and 0.75 in HLG; a tenth of it 0.3583 in PQ [ITU-R BT.2408, ST 2084].
    CHECK(read_grey(pq, 0.5807f) == doctest::Approx(1).epsilon(1e-3));
    CHECK(read_grey(pq, 0.3583f) == doctest::Approx(srgb(0.1)).epsilon(2e-3));
    CHECK(read_as_described(pq, 3).notes.at(0).find("HDR image (PQ)") != std::string::npos);
    auto hlg = image(OIIO::TypeUInt16);
    set_cicp(hlg, { 9, 18, 0, 1 });
    CHECK(read_grey(hlg, 0.75f) == doctest::Approx(1).epsilon(5e-3));
}

TEST_CASE("a profile that cannot be used is passed over with a note")
{
    auto spec = image(OIIO::TypeUInt8, "sRGB");
    const auto grey = grey_gamma(2.2);
    set_icc_profile(spec, grey.data(), grey.size());
    const ColorReading reading = read_as_described(spec, 3);
    CHECK(!reading.transform);
    CHECK(reading.notes.at(0) == "its ICC profile is for GRAY, the image has RGB channels; it was ignored");
    auto linear = image(OIIO::TypeFloat, "Linear");
    const auto icc = adobe_rgb();
    linear.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(icc.size())), icc.data());
    CHECK(read_as_described(linear, 3).notes.at(0) ==
          "the ICC profile was ignored, since the image says that it is linear");
}
