// SPDX-License-Identifier: Apache-2.0
#include "rendering/test_rendering.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "base/colorimetry.h"
#include "rendering/upi.h"

using namespace srisp;

namespace {

/// A grey ramp from 0 to 1 as a camera with these gains saw it.
struct Ramp {
    std::vector<float> rgb = std::vector<float>(3 * 101);
    Vector3 white_balance{ 2, 1, 1.6f };
    Matrix3 color = dnd_camera_to_rgb()[0];

    Ramp()
    {
        for (int x = 0; x < 101; ++x)
            for (int c = 0; c < 3; ++c)
                rgb[std::size_t(x * 3 + c)] = float(x) / 100 / white_balance[std::size_t(c)];
    }
    RawScene scene() const { return { { rgb.data(), 101, 1, 3, 303 }, white_balance, color }; }
    std::vector<float> rendered(const TestRendering& rendering) const
    {
        std::vector<float> photo(rgb.size());
        render(rendering, scene().raw, { photo.data(), 101, 1, 3, 303 });
        return photo;
    }
};

const std::vector<Matrix3>& kOthers = dnd_camera_to_rgb();

} // namespace

TEST_CASE("fixed rendering leaves grey grey, and puts the 97th percentile at 0.9")
{
    const Ramp ramp;
    const std::vector<float> photo = ramp.rendered(fixed_rendering(ramp.scene()));
    for (std::size_t x = 0; x < 101; ++x) {
        CHECK(photo[x * 3] == doctest::Approx(photo[x * 3 + 1]).epsilon(0.01));
        CHECK(photo[x * 3 + 2] == doctest::Approx(photo[x * 3 + 1]).epsilon(0.01));
    }
    CHECK(photo[97 * 3] == doctest::Approx(srgb_curve(0.9)).epsilon(0.005));
    CHECK(photo[0] == 0);
}

TEST_CASE("renderings are the same for the same seed, others for another, and in 8 bits")
{
    const Ramp ramp;
    const auto random = [&](std::uint64_t seed) {
        return ramp.rendered(random_rendering(ramp.scene(), kOthers, Random(seed)));
    };
    const auto camera = [&](std::uint64_t seed) {
        return ramp.rendered(camera_rendering(ramp.scene(), kOthers, draw_camera_gain(Random(seed)), Random(seed)));
    };
    CHECK(random(1) == random(1));
    CHECK(random(1) != random(2));
    CHECK(camera(1) == camera(1));
    CHECK(camera(1) != camera(2));
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (const std::vector<float>& photo : { random(seed), camera(seed) })
            for (const float value : photo) {
                CHECK(value >= 0);
                CHECK(value <= 1);
                CHECK(std::fabs(value * 255 - std::round(value * 255)) < 1e-3);
            }
}

TEST_CASE("a rendering brightens what is brighter, whatever it is")
{
    const Ramp ramp;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto photo = ramp.rendered(camera_rendering(ramp.scene(), kOthers, 1.3, Random(seed)));
        for (std::size_t x = 1; x < 101; ++x)
            CHECK(photo[x * 3 + 1] >= photo[x * 3 - 2] - 1e-6);
    }
}

TEST_CASE("UPI's matrices are those of its cameras, and grey stays grey but for the gains")
{
    const Matrix3 first = dnd_rgb_to_camera()[0];
    const Matrix3 expected{
        .826379f, .295062f, -.121440f, .109196f, .917753f, -.026949f, .035224f, .244491f, .720284f
    };
    for (std::size_t i = 0; i < 9; ++i)
        CHECK(first[i] == doctest::Approx(expected[i]).epsilon(1e-4));
    const UpiParameters parameters = draw_upi(Random(3));
    const Vector3 raw = unprocessed_by_upi(parameters, { 0.5f, 0.5f, 0.5f });
    for (std::size_t c = 0; c < 3; ++c) // the curve leaves 0.5, the gamma does not
        CHECK(raw[c] * parameters.gains[c] == doctest::Approx(std::pow(0.5, 2.2)).epsilon(1e-3));
    CHECK(parameters.gains[0] > parameters.gains[1]);
}
