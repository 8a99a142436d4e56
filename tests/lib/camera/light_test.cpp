// SPDX-License-Identifier: Apache-2.0
#include "camera/light.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("standard lights have the temperatures that they are named by")
{
    const Xy a{ 0.44757f, 0.40745f }, d50{ 0.34567f, 0.35850f }, d75{ 0.29902f, 0.31485f };
    CHECK(light_of_xy(kD65).temperature == doctest::Approx(6504).epsilon(2e-3));
    CHECK(light_of_xy(a).temperature == doctest::Approx(2856).epsilon(2e-3));
    CHECK(light_of_xy(d50).temperature == doctest::Approx(5003).epsilon(3e-3));
    CHECK(light_of_xy(d75).temperature == doctest::Approx(7504).epsilon(3e-3));
    // Daylight lies above the Planckian locus by some 0.003, and A on it.
    CHECK(light_of_xy(kD65).tint == doctest::Approx(9.6).epsilon(0.1));
    CHECK(std::fabs(light_of_xy(a).tint) < 1);
}

TEST_CASE("a light's chromaticity gives the light back")
{
    for (const float temperature : { 1500.0f, 2856.0f, 4000.0f, 6504.0f, 10000.0f, 20000.0f })
        for (const float tint : { -40.0f, 0.0f, 10.0f, 60.0f }) {
            const Light back = light_of_xy(xy_of_light({ temperature, tint }));
            CHECK(back.temperature == doctest::Approx(temperature).epsilon(1e-3));
            CHECK(std::fabs(back.tint - tint) < 0.05f);
        }
}

TEST_CASE("more tint is a greener light")
{
    const Xy plain = xy_of_light({ 5000, 0 }), green = xy_of_light({ 5000, 30 });
    CHECK(green[1] > plain[1]);
    CHECK(light_of_xy({ 0.7f, 0.3f }).temperature == doctest::Approx(kLowestTemperature).epsilon(0.2));
}

TEST_CASE("light sources of EXIF are known but for those that say no light")
{
    REQUIRE(xy_of_light_source(17));
    CHECK((*xy_of_light_source(21))[0] == kD65[0]);
    for (const int code : { 0, 5, 255, -1, 1000 })
        CHECK(xy_of_light_source(code) == nullptr);
}
