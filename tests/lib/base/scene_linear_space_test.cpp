// SPDX-License-Identifier: Apache-2.0
#include "base/scene_linear_space.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

const SceneLinearSpace& space(const std::string& name)
{
    const SceneLinearSpace* const found = find_scene_linear_space(name);
    REQUIRE_MESSAGE(found, name);
    return *found;
}

void check_near(const Matrix3& actual, const Matrix3& expected, double limit)
{
    for (std::size_t i = 0; i < 9; ++i)
        CHECK(std::fabs(actual[i] - expected[i]) <= limit);
}

} // namespace

TEST_CASE("a space is known by its names of before and after, whatever their case")
{
    for (const char* name : { "ACEScg", "acescg", "lin_ap1", "lin_ap1_scene", "ACES - ACEScg" })
        CHECK(std::string(space(name).name) == "ACEScg");
    for (const char* name : { "lin_rec709", "lin_srgb", "lin_rec709_scene", "Linear Rec.709 (sRGB)" })
        CHECK(std::string(space(name).name) == "lin_rec709");
    CHECK(std::string(space("lin_ap0_scene").name) == "ACES2065-1");
    CHECK(std::string(space("lin_rec2020").interop_id) == "lin_rec2020_scene");
    CHECK(std::string(space("lin_p3d65_scene").name) == "lin_p3d65");
    CHECK(std::string(space("xyz").name) == "XYZ");
    CHECK(find_scene_linear_space("sRGB") == nullptr);
    CHECK(find_scene_linear_space("") == nullptr);
}

TEST_CASE("matrices are those that the standards print")
{
    // ACES S-2014-004 (AP1) and SMPTE ST 2065-1 (AP0), each to its own white.
    check_near(inverse(space("ACEScg").from_xyz),
               { 0.6624541811f, 0.1340042065f, 0.1561876870f, 0.2722287168f, 0.6740817658f, 0.0536895174f,
                 -0.0055746495f, 0.0040607335f, 1.0103391003f },
               2e-6);
    check_near(inverse(space("ACES2065-1").from_xyz),
               { 0.9525523959f, 0, 0.0000936786f, 0.3439664498f, 0.7281660966f, -0.0721325464f, 0, 0, 1.0088251844f },
               2e-6);
    check_near(inverse(space("lin_rec709").from_xyz), kSrgbToXyz, 3e-4); // its white is 0.3127, 0.3290 to four digits
    // ITU-R BT.2087 rounds to six.
    check_near(inverse(space("lin_rec2020").from_xyz),
               { 0.636958f, 0.144617f, 0.168881f, 0.262700f, 0.677998f, 0.059302f, 0, 0.028073f, 1.060985f }, 2e-6);
    check_near(space("XYZ").from_xyz, { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, 1e-9);
}

TEST_CASE("adaptation takes a white to the other, and D65 to D50 as Bradford's matrix is printed")
{
    check_near(adaptation(kD65, kD50),
               { 1.0478112f, 0.0228866f, -0.0501270f, 0.0295424f, 0.9904844f, -0.0170491f, -0.0092345f, 0.0150436f,
                 0.7521316f },
               3e-4); // Lindbloom's whites have five digits
    const Vector3 d50 = product(adaptation(kD65, kD50), xyz_of(kD65));
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(d50[c] == doctest::Approx(xyz_of(kD50)[c]).epsilon(1e-5));
}
