// SPDX-License-Identifier: Apache-2.0
#include "train/samples/camera_isp.h"

#include <cmath>

#include <doctest/doctest.h>

#include "lib/train/tensor_tools.h"

#include "train/tensors/color.h"

using namespace srisp::train;

namespace {

/// Nothing is random: true balance, own matrix, no curve, sRGB's encoding.
CameraIspSettings plain()
{
    CameraIspSettings settings;
    settings.balance_error = settings.cast = settings.auto_brightness = settings.other_matrix = settings.curved = 0;
    settings.srgb = 1;
    settings.bt709 = 0;
    settings.lowest_saturation = settings.highest_saturation = 1;
    settings.lowest_style = settings.highest_style = 0;
    return settings;
}

/// A ramp from 0 to 1 in all channels, [1, 3, 1, 65].
torch::Tensor ramp()
{
    return torch::linspace(0, 1, 65).view({ 1, 1, 1, 65 }).expand({ 1, 3, 1, 65 }).contiguous();
}

torch::Tensor rendered(const CameraIspSettings& settings, const torch::Tensor& raw, double gain = 1,
                       std::uint64_t seed = 1)
{
    const auto count = raw.size(0);
    Randoms randoms;
    for (std::int64_t n = 0; n < count; ++n)
        randoms.emplace_back(seed, 0, n);
    const auto own = torch::eye(3).expand({ count, 3, 3 });
    return render_camera(settings, raw, torch::ones({ count, 3 }), own, dnd_rgb_to_camera().unsqueeze(0),
                         torch::full({ count }, gain), randoms);
}

constexpr double kCode = 0.501 / 255; // half of one of 8 bits

} // namespace

TEST_CASE("without a curve a camera's picture is its balanced RAW times the gain, clipped and encoded")
{
    const auto raw = ramp() * torch::tensor({ 0.5f, 1.0f, 0.8f }).view({ 1, 3, 1, 1 });
    Randoms randoms{ Random(1) };
    const auto photo = render_camera(plain(), raw, torch::tensor({ { 2.0f, 1.0f, 1.25f } }), torch::eye(3).unsqueeze(0),
                                     dnd_rgb_to_camera().unsqueeze(0), torch::tensor({ 1.5f }), randoms);
    CHECK(largest(photo - srgb_encoded((ramp() * 1.5).clamp_max(1))) <= kCode);
}

TEST_CASE("a share of the pictures without a curve has a gain of 1")
{
    CameraIspSettings settings = plain();
    const auto without_gain = srgb_encoded(ramp());
    CHECK(largest(rendered(settings, ramp(), 1.5) - without_gain) > 0.1);
    settings.plain = 1;
    CHECK(largest(rendered(settings, ramp(), 1.5) - without_gain) <= kCode);
    settings.curved = 1;
    settings.rolled_off = 0;
    CHECK_FALSE(torch::equal(rendered(settings, ramp(), 1.5), rendered(settings, ramp(), 1)));
}

TEST_CASE("a RAW image that is darker gives a picture that is darker: a camera does not make up for it")
{
    CameraIspSettings settings;
    settings.auto_brightness = 0;
    settings.rolled_off = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const auto bright = rendered(settings, ramp() * 0.8, 1.3, seed);
        const auto dark = rendered(settings, ramp() * 0.2, 1.3, seed);
        CHECK(dark.mean().item<double>() < 0.75 * bright.mean().item<double>());
        // One curve for both: the same RAW value is the same value of the picture.
        CHECK(largest(dark.select(3, 64) - bright.select(3, 16)) <= 0.03);
    }
}

TEST_CASE("curves rise, keep black and white, and brighten middle grey as they are told to")
{
    CameraIspSettings settings = plain();
    settings.curved = 1;
    settings.rolled_off = 0;
    settings.keeps_hue = 0;
    settings.lowest_contrast = settings.highest_contrast = 1.4;
    settings.lowest_middle = settings.highest_middle = 0.5;
    const auto photo = rendered(settings, ramp());
    CHECK((photo.slice(3, 1) - photo.slice(3, 0, -1)).min().item<double>() >= 0);
    CHECK(photo.select(3, 0).max().item<double>() == 0);
    CHECK(photo.select(3, 64).min().item<double>() == 1);
    const auto grey = rendered(settings, torch::full({ 1, 3, 1, 1 }, 0.18));
    CHECK(largest(grey - srgb_encoded(torch::tensor(0.18 * std::exp(0.5)))) <= kCode);
}

TEST_CASE("a curve that rolls off keeps apart what the gain puts above white")
{
    CameraIspSettings settings = plain();
    settings.curved = 1;
    const auto clipped = [&](double share) {
        settings.rolled_off = share;
        int at_white = 0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            at_white += rendered(settings, ramp(), 3, seed).ge(1).sum().item<int>();
        return at_white;
    };
    CHECK(clipped(1) < 0.75 * clipped(0));
}

TEST_CASE("a curve on the largest channel keeps the ratios of linear channels, one per channel does not")
{
    CameraIspSettings settings = plain();
    settings.curved = 1;
    settings.lowest_contrast = settings.highest_contrast = 1.5;
    settings.lowest_middle = settings.highest_middle = 0.6;
    settings.srgb = 0;
    settings.lowest_gamma = settings.highest_gamma = 2;
    const auto raw = torch::tensor({ 0.8f, 0.4f, 0.2f }).view({ 1, 3, 1, 1 });
    const auto ratio = [&](double share) {
        settings.keeps_hue = share;
        const auto linear = rendered(settings, raw).square().flatten();
        return linear[0].item<double>() / linear[2].item<double>();
    };
    CHECK(ratio(1) == doctest::Approx(4).epsilon(0.03));
    CHECK(std::abs(ratio(0) - 4) > 0.5);
}

TEST_CASE("automatic brightness clips one pixel in a hundred of the brightest channel, and never darkens")
{
    CameraIspSettings settings = plain();
    settings.auto_brightness = 1;
    const auto raw = torch::linspace(0, 0.5, 1000).view({ 1, 1, 1, 1000 }).expand({ 1, 3, 1, 1000 }).contiguous();
    const auto channels = torch::tensor({ 0.5f, 1.0f, 0.7f }).view({ 1, 3, 1, 1 });
    const auto photo = rendered(settings, raw * channels);
    const double white = photo.select(1, 1).ge(0.9999).to(torch::kFloat32).mean().item<double>();
    CHECK(white == doctest::Approx(0.01).epsilon(0.3));
    CHECK(largest(rendered(settings, ramp(), 2) - rendered(plain(), ramp(), 2)) == 0);
}

TEST_CASE("a cast makes red and blue err the other way, and only for its share of the images")
{
    CameraIspSettings settings = plain();
    const auto raw = torch::full({ 50, 3, 1, 1 }, 0.2);
    CHECK(largest(rendered(settings, raw) - rendered(settings, raw).mean(1, true)) == 0);
    settings.cast = 1;
    settings.coolest_cast = settings.warmest_cast = 0.4;
    const auto warm = rendered(settings, raw);
    CHECK(warm.select(1, 0).min().item<double>() > warm.select(1, 1).max().item<double>() + 0.05);
    CHECK(warm.select(1, 2).max().item<double>() < warm.select(1, 1).min().item<double>() - 0.05);
}

TEST_CASE("encodings: sRGB's, BT.709's with its line at black, a plain gamma")
{
    CameraIspSettings settings = plain();
    const auto raw = torch::tensor({ 0.01f, 0.3f }).view({ 1, 1, 1, 2 }).expand({ 1, 3, 1, 2 }).contiguous();
    settings.srgb = 0;
    settings.bt709 = 1;
    auto photo = rendered(settings, raw);
    CHECK(std::abs(photo[0][0][0][0].item<double>() - 0.045) <= kCode);
    CHECK(std::abs(photo[0][0][0][1].item<double>() - (1.099 * std::pow(0.3, 0.45) - 0.099)) <= kCode);
    settings.bt709 = 0;
    settings.lowest_gamma = settings.highest_gamma = 2;
    photo = rendered(settings, raw);
    CHECK(std::abs(photo[0][0][0][0].item<double>() - 0.1) <= kCode);
}

TEST_CASE("gains of cameras are log-normal around the median")
{
    const CameraIspSettings settings;
    double sum = 0, squares = 0;
    constexpr int kCameras = 4000;
    for (int i = 0; i < kCameras; ++i) {
        const double log = std::log(draw_camera_gain(settings, Random(3, 1, i)) / settings.gain);
        sum += log;
        squares += log * log;
    }
    CHECK(std::abs(sum / kCameras) < 0.02);
    CHECK(std::sqrt(squares / kCameras) == doctest::Approx(settings.gain_spread).epsilon(0.05));
}

TEST_CASE("the same numbers give the same picture, whatever images are rendered beside it")
{
    const CameraIspSettings settings;
    const auto raw = torch::rand({ 6, 3, 8, 8 }, at::detail::createCPUGenerator(4));
    const auto all = rendered(settings, raw);
    CHECK(all.min().item<double>() >= 0);
    CHECK(all.max().item<double>() <= 1);
    CHECK(largest(all * 255 - (all * 255).round()) < 1e-3);
    CHECK(largest(rendered(settings, raw.slice(0, 0, 2)) - all.slice(0, 0, 2)) <= 1.001 / 255);
    CHECK(largest(rendered(settings, raw, 1, 2) - all) > 0.1);
}
