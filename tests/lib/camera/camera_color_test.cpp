// SPDX-License-Identifier: Apache-2.0
#include "camera/camera_color.h"

#include <cmath>

#include <doctest/doctest.h>

#include "camera/light.h"

using namespace srisp;

namespace {

// A Canon 40D's, of A and D65, as its DNGs have them.
constexpr Matrix3 kWarm{ 0.6436f, 0.0188f, -0.1159f, -0.5113f, 1.2607f, 0.2822f, -0.0901f, 0.1535f, 0.5906f };
constexpr Matrix3 kCool{ 0.6071f, -0.0747f, -0.0856f, -0.7653f, 1.5365f, 0.2441f, -0.2025f, 0.2553f, 0.7315f };
constexpr int kA = 17, kCodeOfD65 = 21;
const Xy kLightA{ 0.44757f, 0.40745f };

CameraFacts camera_with(std::vector<CameraFacts::ColorMatrix> matrices)
{
    CameraFacts facts;
    facts.color_matrices = std::move(matrices);
    return facts;
}

void check_near(const Vector3& actual, const Vector3& expected, double limit)
{
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::fabs(actual[c] - expected[c]) <= limit);
}

Vector3 camera_rgb(const Matrix3& matrix, const Xy& light)
{
    return product(matrix, xyz_of(light));
}

} // namespace

TEST_CASE("what is neutral becomes D50, whatever the light and the matrices")
{
    CameraFacts::ColorMatrix forward{ kWarm, kA };
    forward.forward = { 0.7f, 0.15f, 0.11f, 0.3f, 0.65f, 0.05f, 0.01f, 0.03f, 0.78f };
    for (const CameraFacts& camera :
         { camera_with({ { kCool, kCodeOfD65 } }), camera_with({ { kCool, kCodeOfD65 }, { kWarm, kA } }),
           camera_with({ { kWarm, 0 } }), camera_with({ forward }) })
        for (const Vector3& neutral : { Vector3{ 0.45f, 1, 0.7f }, Vector3{ 0.8f, 1, 0.3f }, Vector3{ 1, 0.5f, 0.5f } })
            check_near(product(balanced_to_xyz(camera, neutral), Vector3{ 1, 1, 1 }), xyz_of(kD50), 1e-5);
}

TEST_CASE("a single matrix is dcraw's: white of its own light, and balance in camera RGB")
{
    const CameraFacts camera = camera_with({ { kCool, kCodeOfD65 } });
    // dcraw: linear sRGB = inverse of the rows of (matrix · sRGB → XYZ), each divided by its sum.
    const Matrix3 srgb_to_xyz = rgb_to_xyz(kSrgbChromaticities);
    const Matrix3 to_srgb = inverse(row_normalized(product(kCool, srgb_to_xyz)));
    const Matrix3 ours =
        product(inverse(srgb_to_xyz), product(adaptation(kD50, kD65), balanced_to_xyz(camera, { 0.7f, 1, 0.4f })));
    for (std::size_t i = 0; i < 9; ++i)
        CHECK(ours[i] == doctest::Approx(to_srgb[i]).epsilon(1e-4));
}

TEST_CASE("of two matrices that of the light is taken, and what lies between is mixed in reciprocal temperature")
{
    const CameraFacts camera = camera_with({ { kCool, kCodeOfD65 }, { kWarm, kA } });
    const auto check = [&](const Matrix3& matrix, const Xy& light) {
        const Vector3 neutral = camera_rgb(matrix, light), color{ 0.2f, 0.3f, 0.1f };
        const Vector3 seen = product(matrix, product(adaptation(kD50, light), color));
        const Vector3 balanced{ seen[0] / neutral[0], seen[1] / neutral[1], seen[2] / neutral[2] };
        check_near(product(balanced_to_xyz(camera, neutral), balanced), color, 2e-4);
        const Vector3 told = neutral_under(camera, light);
        check_near({ told[0] / told[1], 1, told[2] / told[1] }, { neutral[0] / neutral[1], 1, neutral[2] / neutral[1] },
                   1e-3);
    };
    check(kWarm, kLightA);
    check(kCool, kD65);
    const float warm = light_of_xy(kLightA).temperature, cool = light_of_xy(kD65).temperature;
    const float middle = 2 / (1 / warm + 1 / cool);
    Matrix3 mean;
    for (std::size_t i = 0; i < 9; ++i)
        mean[i] = (kWarm[i] + kCool[i]) / 2;
    check(mean, xy_of_light({ middle, 0 }));
}

TEST_CASE("forward matrices go before colour matrices, if all have them")
{
    const Matrix3 identity_to_d50 = diagonal(xyz_of(kD50));
    CameraFacts::ColorMatrix warm{ kWarm, kA }, cool{ kCool, kCodeOfD65 };
    warm.forward = cool.forward = identity_to_d50;
    check_near(product(balanced_to_xyz(camera_with({ warm, cool }), { 0.5f, 1, 0.5f }), Vector3{ 1, 0, 0 }),
               { xyz_of(kD50)[0], 0, 0 }, 1e-6);
    cool.forward = {};
    CHECK(std::fabs(product(balanced_to_xyz(camera_with({ warm, cool }), { 0.5f, 1, 0.5f }), Vector3{ 1, 0, 0 })[1]) >
          0.01f);
}

TEST_CASE("matrices that cannot be a camera's are none")
{
    CHECK(has_camera_color(camera_with({ { kCool, kCodeOfD65 } })));
    CHECK_FALSE(has_camera_color(camera_with({})));
    Matrix3 broken = kCool;
    broken[4] = NAN;
    CHECK_FALSE(has_camera_color(camera_with({ { broken, kA } })));
    CHECK_FALSE(has_camera_color(camera_with({ { Matrix3{ 1, 1, 1, 1, 1, 1, 1, 1, 1 }, kA } })));
    CHECK_FALSE(has_camera_color(camera_with({ { Matrix3{ -1, 0, 0, 0, 1, 0, 0, 0, 1 }, kA } })));
    // The other one is taken then.
    CHECK(has_camera_color(camera_with({ { broken, kA }, { kCool, kCodeOfD65 } })));
}
