// SPDX-License-Identifier: Apache-2.0
#include "train/samples/simulation.h"

#include <stdexcept>

#include <doctest/doctest.h>

#include "lib/train/small_pack.h"
#include "train/tensors/color.h"
#include "train/tensors/random.h"

using namespace srisp::train;

namespace {

/// One light, even light, no noise: what is left is camera and exposure.
SimulationSettings plain()
{
    SimulationSettings settings;
    settings.highest_unevenness = 0;
    settings.lowest_shot = settings.highest_shot = 1e-8;
    settings.photo.lowest_gamma = settings.photo.highest_gamma = 2.2;
    settings.photo.lowest_saturation = settings.photo.highest_saturation = 1;
    settings.lowest_exposure = settings.highest_exposure = 0.5;
    return settings;
}

std::vector<Capture> captures(const SimulationSettings& settings, int count, std::uint64_t seed)
{
    const SimulatedCameras cameras(small_cameras());
    std::vector<Capture> result;
    for (int i = 0; i < count; ++i)
        result.push_back(draw_capture(settings, cameras, false, Random(seed, 1, i)));
    return result;
}

} // namespace

TEST_CASE("white in even light has the exposure in green, and the true white balance makes it grey")
{
    const auto settings = plain();
    const auto shots = captures(settings, 6, 1);
    const auto raw = simulate(settings, torch::ones({ 6, 3, 8, 8 }), shots, randoms(6, 2));
    CHECK((raw.select(1, 1) - 0.5).abs().max().item<double>() < 2e-3);
    const auto grey = raw.mean({ 2, 3 }) * white_balances(shots);
    CHECK((grey - 0.5).abs().max().item<double>() < 1e-3);
}

TEST_CASE("the camera's matrix gives the scene's linear sRGB back")
{
    const auto settings = plain();
    const auto shots = captures(settings, 6, 3);
    torch::manual_seed(1);
    // Dull colours: brighter ones leave this camera's gamut or clip.
    const auto linear = torch::rand({ 6, 3, 8, 8 }) * 0.2 + 0.4;
    const auto scenes = camera_scenes(settings, linear.pow(1 / 2.2), shots, randoms(6, 2));
    const auto balanced = scenes * white_balances(shots).view({ 6, 3, 1, 1 });
    const auto back = torch::bmm(color_matrices(shots), balanced.flatten(2)).view_as(linear);
    CHECK((back - linear).abs().max().item<double>() < 1e-4);
}

TEST_CASE("exposures spread evenly over their range's logarithm, or put the scene's own percentile there")
{
    SimulationSettings settings = plain();
    settings.lowest_exposure = 0.06;
    settings.highest_exposure = 2.5;
    double mean = 0, squares = 0;
    const auto shots = captures(settings, 1000, 4);
    for (const Capture& shot : shots) {
        mean += std::log(shot.exposure) / 1000;
        squares += std::log(shot.exposure) * std::log(shot.exposure) / 1000;
    }
    const double low = std::log(0.06), high = std::log(2.5);
    CHECK(std::abs(mean - (low + high) / 2) < 0.14);
    CHECK(std::sqrt(squares - mean * mean) == doctest::Approx((high - low) / std::sqrt(12)).epsilon(0.06));

    settings = plain();
    settings.exposure_of = "percentile";
    torch::manual_seed(2);
    const auto raw = simulate(settings, torch::rand({ 6, 3, 32, 32 }), captures(settings, 6, 5), randoms(6, 2));
    CHECK((row_quantile(raw.amax(1).flatten(1), 0.97) - 0.5).abs().max().item<double>() < 2e-3);
}

TEST_CASE("noise has the variance of the law, divided by the pixels that are averaged")
{
    SimulationSettings settings = plain();
    settings.lowest_shot = settings.highest_shot = 0.01;
    settings.lowest_averaged = settings.highest_averaged = 4;
    auto shots = captures(settings, 1, 6);
    CHECK(shots[0].shot == doctest::Approx(0.0025));
    // ln read = 2.18 ln shot + 1.20 ± 4 · 0.26
    CHECK(std::log(shots[0].read * 4) == doctest::Approx(2.18 * std::log(0.01) + 1.20).epsilon(0.13));
    shots[0].color.to_camera = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    const auto raw = simulate(settings, torch::full({ 1, 3, 64, 64 }, 0.9f), shots, randoms(1, 2));
    const double level = 0.5 * std::pow(0.9, 2.2);
    const double variance = 0.0025 * level + shots[0].read;
    CHECK(raw.mean().item<double>() == doctest::Approx(level).epsilon(0.005));
    CHECK(raw.var().item<double>() == doctest::Approx(variance).epsilon(0.05)); // standard error 1.3 %
}

TEST_CASE("smooth fields have mean 0 and deviation 1 and are smooth")
{
    auto random = randoms(5, 7);
    const auto fields = smooth_fields(random, 96, 64, torch::kCPU);
    CHECK(fields.mean({ 2, 3 }).abs().max().item<double>() < 0.02);
    CHECK((fields.square().mean({ 2, 3 }) - 1).abs().max().item<double>() < 0.05);
    CHECK(fields.diff(1, 3).abs().max().item<double>() < 0.6);
    CHECK(fields.select(0, 0).allclose(fields.select(0, 1)) == false);
}

TEST_CASE("uneven and mixed light vary over the scene, and the mean of both lights is the true balance")
{
    SimulationSettings settings = plain();
    settings.lowest_unevenness = settings.highest_unevenness = 0.7;
    auto scenes = camera_scenes(settings, torch::ones({ 4, 3, 64, 64 }), captures(settings, 4, 8), randoms(4, 2));
    CHECK((scenes.select(1, 1).log().std({ 1, 2 }, false) - 0.7).abs().max().item<double>() < 0.04);

    settings = plain();
    settings.mixed_light = 1;
    settings.light.daylight = settings.light.artificial = 0;
    const auto shots = captures(settings, 40, 9);
    CHECK(shots[0].lights.size() == 2);
    scenes = camera_scenes(settings, torch::ones({ 40, 3, 64, 64 }), shots, randoms(40, 2));
    const auto balanced = scenes * white_balances(shots).view({ 40, 3, 1, 1 });
    CHECK((balanced.mean({ 0, 2, 3 }) - 1).abs().max().item<double>() < 0.03);
    CHECK((balanced.select(1, 2).amax({ 1, 2 }) / balanced.select(1, 2).amin({ 1, 2 })).max().item<double>() > 1.5);
}

TEST_CASE("other cameras' matrices leave out the own camera and those for validation")
{
    const SimulatedCameras cameras(small_cameras());
    auto shots = captures(plain(), 20, 10);
    auto random = randoms(20, 1);
    const auto others = other_color_matrices(cameras, shots, 3, random);
    CHECK(others.sizes() == at::IntArrayRef({ 20, 3, 3, 3 }));
    CHECK((others.sum(3) - 1).abs().max().item<double>() < 1e-4);
    // Four cameras for training: the three others, each once.
    const auto own = color_matrices(shots).unsqueeze(1);
    CHECK((others - own).abs().amax({ 2, 3 }).min().item<double>() > 1e-3);
    CHECK((others.select(1, 0) - others.select(1, 1)).abs().amax({ 1, 2 }).min().item<double>() > 1e-3);
    for (Capture& shot : shots)
        shot.camera = 4;
    const auto held_out = srisp::train::camera_color(cameras.to_camera(4, shots[0].lights[0])).color;
    random = randoms(20, 1);
    const auto all = other_color_matrices(cameras, shots, 4, random);
    const auto matrix = torch::from_blob(const_cast<float*>(held_out.data()), { 3, 3 });
    CHECK((all[0] - matrix).abs().amax({ 1, 2 }).min().item<double>() > 1e-3);
}

TEST_CASE("extreme settings give RAW in [0, 1] and no number that is none")
{
    SimulationSettings settings;
    settings.mixed_light = 0.5;
    settings.lowest_unevenness = settings.highest_unevenness = 3;
    settings.lowest_exposure = 1e-3;
    settings.highest_exposure = 100;
    settings.highest_flare = 0.5;
    settings.lowest_black_error = -0.1;
    settings.highest_black_error = 0.1;
    settings.highest_shot = 1;
    settings.photo.expansion = settings.photo.histogram = settings.photo.s_curve = 1;
    for (const char* exposure_of : { "white", "percentile" })
        for (const double level : { 0.0, 0.5, 1.0 }) {
            settings.exposure_of = exposure_of;
            const auto raw =
                simulate(settings, torch::full({ 8, 3, 32, 32 }, level), captures(settings, 8, 11), randoms(8, 2));
            CHECK(torch::isfinite(raw).all().item<bool>());
            CHECK(raw.min().item<double>() >= 0);
            CHECK(raw.max().item<double>() <= 1);
        }
}
