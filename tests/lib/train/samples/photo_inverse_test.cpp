// SPDX-License-Identifier: Apache-2.0
#include "train/samples/photo_inverse.h"

#include <doctest/doctest.h>

#include "lib/train/small_pack.h"

using namespace srisp::train;

namespace {

PhotoInverseSettings fixed(double gamma, double saturation)
{
    PhotoInverseSettings settings;
    settings.lowest_gamma = settings.highest_gamma = gamma;
    settings.lowest_saturation = settings.highest_saturation = saturation;
    return settings;
}

torch::Tensor grey_ramp(int length)
{
    return torch::linspace(0, 1, length).view({ 1, 1, 1, length }).expand({ 1, 3, 1, length }).contiguous();
}

} // namespace

TEST_CASE("gamma and saturation are undone as written down")
{
    torch::manual_seed(1);
    const auto photos = torch::rand({ 2, 3, 5, 7 });
    auto random = randoms(2, 1);
    const auto linear = undo_rendering(fixed(2.5, 1.3), photos, random);
    double largest = 0;
    for (int n = 0; n < 2; ++n)
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 7; ++x) {
                double v[3], luma = 0;
                const double weights[] = { 0.2126, 0.7152, 0.0722 };
                for (int c = 0; c < 3; ++c) {
                    v[c] = std::pow(photos[n][c][y][x].item<double>(), 2.5);
                    luma += weights[c] * v[c];
                }
                for (int c = 0; c < 3; ++c)
                    largest = std::max(largest, std::abs(std::max(0.0, luma + 1.3 * (v[c] - luma)) -
                                                         linear[n][c][y][x].item<double>()));
            }
    CHECK(largest < 2e-6);
}

TEST_CASE("an S-curve that is removed in full is smoothstep's inverse")
{
    auto settings = fixed(1, 1);
    settings.s_curve = settings.lowest_s_curve = 1;
    auto random = randoms(1, 1);
    const auto v = undo_rendering(settings, grey_ramp(41), random);
    CHECK(torch::allclose(v * v * (3 - 2 * v), grey_ramp(41), 0, 3e-6));
    // [method 4] golden values
    random = randoms(1, 1);
    const auto golden =
        undo_rendering(settings, torch::tensor({ 0.1f, 0.75f }).view({ 1, 1, 1, 2 }).expand({ 1, 3, 1, 2 }), random);
    CHECK(golden[0][0][0][0].item<double>() == doctest::Approx(0.1958001).epsilon(1e-6));
    CHECK(golden[0][2][0][1].item<double>() == doctest::Approx(0.6736482).epsilon(1e-6));
}

TEST_CASE("expanded highlights put white where it is asked for and keep hue")
{
    auto settings = fixed(1, 1);
    settings.expansion = 1;
    settings.lowest_white = settings.highest_white = 6;
    auto random = randoms(1, 1);
    const auto photo = torch::tensor({ 1.0f, 0.5f, 0.25f, 0.2f, 0.1f, 0.05f }).view({ 1, 2, 3 }).permute({ 0, 2, 1 });
    const auto v = undo_rendering(settings, photo.contiguous().unsqueeze(2), random).squeeze(2)[0];
    CHECK(v[0][0].item<double>() == doctest::Approx(6).epsilon(1e-5));
    CHECK(v[2][0].item<double>() == doctest::Approx(1.5).epsilon(1e-5));
    CHECK(v[0][1].item<double>() == doctest::Approx(0.2).epsilon(0.04));
    CHECK((v[0][1] / v[2][1]).item<double>() == doctest::Approx(4).epsilon(1e-4));
}

TEST_CASE("a new histogram has the deviation of ln luminance that is asked for, and keeps the order of tones")
{
    auto settings = fixed(2.2, 1);
    settings.histogram = settings.lowest_strength = 1;
    settings.lowest_skew = settings.highest_skew = 0;
    for (const double spread : { 0.5, 1.2, 2.0 }) {
        settings.lowest_spread = settings.highest_spread = spread;
        auto random = randoms(1, 1);
        const auto tones = undo_rendering(settings, grey_ramp(4096), random)[0][0][0];
        INFO("spread ", spread);
        CHECK(tones.slice(0, 100).log().std().item<double>() == doctest::Approx(spread).epsilon(0.06));
        CHECK((tones.slice(0, 1) - tones.slice(0, 0, -1)).min().item<double>() >= 0);
    }
}

TEST_CASE("flattening takes brightness from the large parts of a picture, not from their details")
{
    auto settings = fixed(1, 1);
    settings.flattening = settings.lowest_flattening = settings.highest_flattening = 1;
    // Two halves, one four times as bright as the other, both with a checkerboard of 0.8 and 1.25.
    auto photo = torch::full({ 1, 3, 32, 32 }, 0.1f);
    photo.slice(3, 0, 16).mul_(4);
    const auto checkers = (torch::arange(32).view({ 32, 1 }) + torch::arange(32)).remainder(2) * 0.45 + 0.8;
    auto random = randoms(1, 1);
    const auto flat = undo_rendering(settings, photo * checkers, random);
    const auto left = flat.slice(3, 0, 6).log().mean(), right = flat.slice(3, 26).log().mean();
    CHECK(std::abs((left - right).item<double>()) < 0.35); // of ln 4 = 1.39
    CHECK((flat[0][0][4][4] / flat[0][0][4][5]).item<double>() == doctest::Approx(0.8 / 1.25).epsilon(0.05));
}

TEST_CASE("no photo and no setting gives a number that is none")
{
    PhotoInverseSettings settings;
    settings.s_curve = settings.expansion = settings.histogram = settings.flattening = 1;
    settings.highest_flattening = 1;
    settings.highest_white = 100;
    settings.lowest_gamma = 1;
    settings.highest_gamma = 6;
    settings.highest_spread = 4;
    settings.lowest_skew = -1;
    settings.highest_skew = 1;
    settings.highest_saturation = 4;
    torch::manual_seed(2);
    for (const auto& photos :
         { torch::zeros({ 8, 3, 16, 16 }), torch::ones({ 8, 3, 16, 16 }), torch::rand({ 8, 3, 16, 16 }) })
        for (int seed = 0; seed < 5; ++seed) {
            auto random = randoms(8, seed);
            const auto linear = undo_rendering(settings, photos, random);
            CHECK(torch::isfinite(linear).all().item<bool>());
            CHECK(linear.min().item<double>() >= 0);
        }
}
