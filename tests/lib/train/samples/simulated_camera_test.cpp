// SPDX-License-Identifier: Apache-2.0
#include "train/samples/simulated_camera.h"

#include <doctest/doctest.h>

#include "lib/train/small_pack.h"

using namespace srisp;
using namespace srisp::train;

namespace {

/// The integral written out: what a camera's channel sees of a unit of linear sRGB.
double seen(const PackedCameras& pack, int camera, int channel, int primary, const std::vector<float>& light)
{
    double sum = 0;
    for (int i = 0; i < kPackWavelengths; ++i)
        sum += double(pack.sensitivities[(camera * 3 + channel) * kPackWavelengths + i]) * light[i] *
               pack.reflectance[primary * kPackWavelengths + i];
    return sum;
}

} // namespace

TEST_CASE("a camera in a light is the integral of sensitivity, light and reflectance")
{
    const PackedCameras pack = small_cameras();
    const SimulatedCameras cameras(pack);
    const auto light = cameras.light("lamp");
    REQUIRE(light.size() == std::size_t(kPackWavelengths));
    CHECK(cameras.light("candle").empty());
    const Matrix3 matrix = cameras.to_camera(3, light);
    for (int i = 0; i < 9; ++i)
        CHECK(matrix[i] == doctest::Approx(seen(pack, 3, i / 3, i % 3, light)).epsilon(1e-6));
}

TEST_CASE("a pack has cameras for training, for validation, or not")
{
    PackedCameras pack = small_cameras();
    CHECK(SimulatedCameras(pack).has(true));
    CHECK(SimulatedCameras(pack).has(false));
    pack.validation.assign(5, false);
    CHECK_FALSE(SimulatedCameras(pack).has(true));
    pack.validation.assign(5, true);
    CHECK_FALSE(SimulatedCameras(pack).has(false));
}

TEST_CASE("white balance makes the camera's white grey, and its matrix then gives linear sRGB back")
{
    const SimulatedCameras cameras(small_cameras());
    const CameraColor color = camera_color(cameras.to_camera(1, cameras.light("day")));
    for (int row = 0; row < 3; ++row) {
        float white = 0, sum = 0;
        for (int k = 0; k < 3; ++k) {
            white += color.to_camera[row * 3 + k];
            sum += color.color[row * 3 + k];
        }
        CHECK(white * color.white_balance[row] == doctest::Approx(1).epsilon(1e-6));
        CHECK(sum == doctest::Approx(1).epsilon(1e-5));
        for (int column = 0; column < 3; ++column) {
            double back = 0;
            for (int k = 0; k < 3; ++k)
                back += color.color[row * 3 + k] * color.white_balance[k] * color.to_camera[k * 3 + column];
            CHECK(back == doctest::Approx(row == column).epsilon(1e-4).scale(1));
        }
    }
    CHECK(color.white_balance[1] == 1);
}

TEST_CASE("warm black bodies need more blue than cool ones, and lights come in the shares that are asked for")
{
    const SimulatedCameras cameras(small_cameras());
    LightSettings settings;
    settings.daylight = settings.artificial = settings.highest_ripple = 0;
    const auto blue_gain = [&](double temperature) {
        settings.lowest_temperature_k = settings.highest_temperature_k = temperature;
        Random random(1);
        return camera_color(cameras.to_camera(0, cameras.draw_light(settings, random))).white_balance[2];
    };
    CHECK(blue_gain(2300) > 2 * blue_gain(5000));
    CHECK(blue_gain(5000) > 1.2 * blue_gain(11000));

    settings.daylight = 0.4;
    settings.artificial = 0.15;
    int day = 0, lamp = 0;
    for (int i = 0; i < 2000; ++i) {
        Random random(2, 0, i);
        const auto light = cameras.draw_light(settings, random);
        day += light == cameras.light("day");
        lamp += light == cameras.light("lamp");
    }
    CHECK(std::abs(day / 2000.0 - 0.40) < 0.045);
    CHECK(std::abs(lamp / 2000.0 - 0.15) < 0.033);
}
