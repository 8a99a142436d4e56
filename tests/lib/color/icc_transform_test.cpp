// SPDX-License-Identifier: Apache-2.0
#include "color/icc_transform.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include "icc_profiles.h"
#include "shared_files.h"

using namespace srisp;

namespace {

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

std::string refusal(const std::vector<unsigned char>& icc, int channels)
{
    const auto transform = color_transform_from_icc(icc.data(), icc.size(), channels);
    REQUIRE(!transform);
    return transform.error().message;
}

} // namespace

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
    const auto transform = color_transform_from_icc(bytes, icc->type().size(), 3);
    REQUIRE(transform);
    float grey[3] = { 0.5f, 0.5f, 0.5f }, red[3] = { 1, 0, 0 };
    CHECK((*transform)->apply(grey, 1) == 0);
    CHECK(grey[1] == doctest::Approx(0.5).epsilon(1e-4));
    CHECK((*transform)->apply(red, 1) > 0);
}

TEST_CASE("a grey profile gives a grey curve")
{
    const auto icc = grey_gamma(1.0);
    const auto transform = color_transform_from_icc(icc.data(), icc.size(), 1);
    REQUIRE(transform);
    float grey[3] = { 0.18f, 0.18f, 0.18f };
    (*transform)->apply(grey, 1);
    CHECK(grey[0] == doctest::Approx(srgb_encoded(0.18f)).epsilon(1e-4));
    CHECK(grey[0] == grey[1]);
    CHECK(grey[0] == grey[2]);
}

TEST_CASE("a profile that is sRGB itself is skipped")
{
    const auto icc = profile_bytes(cmsCreate_sRGBProfile());
    const auto transform = color_transform_from_icc(icc.data(), icc.size(), 3);
    REQUIRE(bool(transform));
    CHECK(*transform == nullptr);
}

TEST_CASE("the profile that most cameras write is sRGB, though its numbers are rounded; others are not")
{
    // Its pure green is more than half an 8-bit step away.
    const auto with_green_at = [](double x) {
        const cmsCIExyY white = { 0.3127, 0.3290, 1 };
        const cmsCIExyYTRIPLE primaries = { { 0.64, 0.33, 1 }, { x, 0.60, 1 }, { 0.15, 0.06, 1 } };
        double srgb[5] = { 2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045 };
        cmsToneCurve* curve = cmsBuildParametricToneCurve(nullptr, 4, srgb);
        cmsToneCurve* curves[3] = { curve, curve, curve };
        const auto bytes = profile_bytes(cmsCreateRGBProfile(&white, &primaries, curves));
        cmsFreeToneCurve(curve);
        const auto transform = color_transform_from_icc(bytes.data(), bytes.size(), 3);
        REQUIRE(transform);
        return *transform;
    };
    CHECK(with_green_at(0.30) == nullptr);
    CHECK(with_green_at(0.31) != nullptr);
    SKIP_WITHOUT_SHARED("data/fullsize/canon_5d3_22mpx.jpg");
    auto input = OIIO::ImageInput::open(shared_file("data/fullsize/canon_5d3_22mpx.jpg"));
    REQUIRE(input);
    const auto* icc = input->spec().find_attribute("ICCProfile");
    REQUIRE(icc);
    const auto transform = color_transform_from_icc(icc->data(), icc->type().size(), 3);
    REQUIRE(bool(transform));
    CHECK(*transform == nullptr);
}

TEST_CASE("the tables of a profile are made once")
{
    const auto icc = adobe_rgb();
    const auto first = color_transform_from_icc(icc.data(), icc.size(), 3);
    const auto second = color_transform_from_icc(std::vector(icc).data(), icc.size(), 3);
    REQUIRE(bool(first));
    REQUIRE(bool(second));
    CHECK(first->get() == second->get());
    const auto grey = color_transform_from_icc(icc.data(), icc.size(), 1);
    CHECK(!grey);
}

TEST_CASE("damaged and unfitting profiles are named")
{
    CHECK(refusal(std::vector<unsigned char>(200, 7), 3) ==
          "its ICC profile of 200 bytes is damaged: it does not say that it is one");
    CHECK(refusal(grey_gamma(2.2), 3) == "its ICC profile is for GRAY, the image has RGB channels");
    CHECK(refusal(adobe_rgb(), 1) == "its ICC profile is for RGB, the image has grey channels");
    auto truncated = adobe_rgb();
    truncated.resize(200);
    CHECK(refusal(truncated, 3).find("ICC profile") != std::string::npos);
}
