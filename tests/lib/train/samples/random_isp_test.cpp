// SPDX-License-Identifier: Apache-2.0
#include "train/samples/random_isp.h"

#include <algorithm>
#include <array>

#include <doctest/doctest.h>

#include "lib/train/small_pack.h"

using namespace srisp::train;

namespace {

/// Everything fixed: grey world, target, one matrix, γ 2.5, smoothstep.
RandomIspSettings certain()
{
    RandomIspSettings settings;
    settings.true_white_balance = 0;
    settings.auto_exposure = 1;
    settings.lowest_target = settings.highest_target = 0.8;
    settings.lowest_gamma = settings.highest_gamma = 2.5;
    settings.smoothstep = "always";
    return settings;
}

using Pixel = std::array<double, 3>;

std::vector<Pixel> pixels(const torch::Tensor& image)
{
    std::vector<Pixel> result;
    const auto flat = image.flatten(1).contiguous();
    for (std::int64_t i = 0; i < flat.size(1); ++i)
        result.push_back({ flat[0][i].item<double>(), flat[1][i].item<double>(), flat[2][i].item<double>() });
    return result;
}

double ranked(std::vector<double> values, double q)
{
    std::sort(values.begin(), values.end());
    return values[std::lround(q * (values.size() - 1))];
}

/// Grey-world gains, pixel by pixel. [method 4]
Pixel grey_world_gains(const std::vector<Pixel>& raw)
{
    std::vector<double> luma;
    for (const Pixel& p : raw)
        luma.push_back(0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]);
    const double low = ranked(luma, 0.05), high = ranked(luma, 0.95);
    Pixel mean{};
    int count = 0;
    for (std::size_t i = 0; i < raw.size(); ++i)
        if (luma[i] >= low && luma[i] <= high) {
            for (int c = 0; c < 3; ++c)
                mean[c] += raw[i][c];
            ++count;
        }
    for (double& m : mean)
        m = m / count + 1e-4;
    return { mean[1] / mean[0], 1, mean[1] / mean[2] };
}

double clip(double v)
{
    return std::clamp(v, 0.0, 1.0);
}

/// Gains, one exposure for the percentile, matrix, a curve; not quantised.
template<class Curve> std::vector<Pixel> rendered(std::vector<Pixel> raw, const Pixel& balance, double target,
                                                  const torch::Tensor& matrix, Curve curve)
{
    std::vector<double> grey;
    for (Pixel& p : raw) {
        for (int c = 0; c < 3; ++c)
            p[c] *= balance[c];
        grey.push_back((p[0] + p[1] + p[2]) / 3);
    }
    const double gain = std::clamp(target / ranked(grey, 0.97), 0.5, 25.0);
    for (Pixel& p : raw) {
        Pixel linear{};
        for (int row = 0; row < 3; ++row)
            for (int c = 0; c < 3; ++c)
                linear[row] += matrix[row][c].item<double>() * clip(p[c] * gain);
        for (int c = 0; c < 3; ++c)
            p[c] = curve(clip(linear[c]));
    }
    return raw;
}

torch::Tensor test_matrix()
{
    return torch::tensor({ 1.6f, -0.4f, -0.2f, -0.2f, 1.5f, -0.3f, 0.1f, -0.6f, 1.5f }).view({ 3, 3 });
}

/// Of values of 8 bits against unquantised ones: the largest distance in codes; half a code is rounding.
double largest_codes(const torch::Tensor& image, const std::vector<Pixel>& expected)
{
    const auto actual = pixels(image);
    double largest = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, 255 * std::abs(actual[i][c] - expected[i][c]));
    return largest;
}

} // namespace

TEST_CASE("a random rendering equals the plain one, pixel by pixel")
{
    torch::manual_seed(1);
    const auto raw = torch::rand({ 2, 3, 12, 17 }) * torch::tensor({ 0.2f, 0.5f, 0.3f }).view({ 1, 3, 1, 1 });
    auto random = randoms(2, 1);
    const auto photos =
        render_random(certain(), raw, torch::ones({ 2, 3 }), test_matrix().view({ 1, 1, 3, 3 }), random);
    for (int n = 0; n < 2; ++n) {
        const auto values = pixels(raw[n]);
        const auto expected = rendered(values, grey_world_gains(values), 0.8, test_matrix(), [](double v) {
            v = std::pow(v, 1 / 2.5);
            return 3 * v * v - 2 * v * v * v;
        });
        CHECK(largest_codes(photos[n], expected) < 0.51);
    }
    CHECK(torch::allclose(photos * 255, (photos * 255).round(), 0, 1e-4));
}

TEST_CASE("a fixed rendering equals the plain one, pixel by pixel")
{
    torch::manual_seed(2);
    const auto raw = torch::rand({ 1, 3, 12, 17 }) * 0.45;
    const auto photo = render_fixed(raw, torch::tensor({ 2.0f, 1.0f, 1.5f }).view({ 1, 3 }), test_matrix().unsqueeze(0),
                                    torch::tensor(0.7));
    const auto expected = rendered(pixels(raw[0]), { 2.0, 1.0, 1.5 }, 0.7, test_matrix(), [](double v) {
        return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    });
    CHECK(largest_codes(photo[0], expected) < 0.51);
}

TEST_CASE("a scene's brightness does not show in a fixed rendering, and clipped highlights are white in it")
{
    torch::manual_seed(3);
    auto raw = torch::rand({ 1, 3, 32, 32 }) * 0.3;
    const auto target = torch::tensor(0.9);
    const auto balance = torch::tensor({ 2.0f, 1.0f, 1.5f }).view({ 1, 3 }), matrix = test_matrix().unsqueeze(0);
    CHECK((render_fixed(raw, balance, matrix, torch::tensor(0.9)) -
           render_fixed(raw * 0.25, balance, matrix, torch::tensor(0.9)))
              .abs()
              .max()
              .item<double>() < 0.0045);
    raw.slice(3, 0, 16).fill_(1);
    const auto white = render_fixed(raw, balance, matrix, torch::tensor(0.9)).slice(3, 0, 16);
    CHECK((white.amax(1) - white.amin(1)).max().item<double>() == 0);
}

TEST_CASE("gains below 1 leave clipped highlights grey only with neutral highlights")
{
    auto settings = certain();
    settings.true_white_balance = 1;
    settings.white_balance_error = 0;
    settings.lowest_target = settings.highest_target = 0.5;
    const auto balance = torch::tensor({ 2.0f, 1.0f, 1.5f }).view({ 1, 3 });
    const auto matrix = torch::eye(3).view({ 1, 1, 3, 3 });
    const auto spread = [&] {
        auto random = randoms(1, 1);
        const auto photo = render_random(settings, torch::ones({ 1, 3, 8, 8 }), balance, matrix, random);
        return (photo.amax(1) - photo.amin(1)).max().item<double>();
    };
    CHECK(spread() > 0.1);
    settings.neutral_highlights = true;
    CHECK(spread() == 0);
}

TEST_CASE("white balance is true as often as asked, within its error; matrices are convex mixes; exposures keep limits")
{
    RandomIspSettings settings;
    settings.auto_exposure = 0;
    settings.lowest_gain = settings.highest_gain = 1;
    settings.lowest_gamma = settings.highest_gamma = 1;
    settings.smoothstep = "never";
    // Flat images: true gains of 2 and grey world's of about 1 tell apart which one was used.
    const int count = 400;
    auto random = randoms(count, 4);
    auto photos = render_random(settings, torch::full({ count, 3, 4, 4 }, 0.2f),
                                torch::tensor({ 2.0f, 1.0f, 2.0f }).expand({ count, 3 }),
                                torch::eye(3).view({ 1, 1, 3, 3 }), random);
    const auto red = photos.select(1, 0).select(1, 0).select(1, 0);
    const auto is_true = red > 0.3;
    CHECK(std::abs(is_true.to(torch::kFloat32).mean().item<double>() - 0.5) < 0.1);
    CHECK(((red - 0.4).abs() < 0.4 * 0.04 + 0.003).logical_or(is_true.logical_not()).all().item<bool>());
    CHECK(((red - 0.2).abs() < 0.003).logical_or(is_true).all().item<bool>());

    // Three one-hot "matrices": the weights show in the red channel's channels.
    settings.mixed_matrices = 2;
    settings.true_white_balance = 0;
    auto candidates = torch::zeros({ 1, 3, 3, 3 });
    for (int k = 0; k < 3; ++k)
        candidates[0][k][k].fill_(0.5);
    random = randoms(count, 5);
    photos =
        render_random(settings, torch::full({ count, 3, 2, 2 }, 0.6f), torch::ones({ count, 3 }), candidates, random);
    const auto weights = photos.select(2, 0).select(2, 0) / 0.9;
    CHECK((weights.sum(1) - 1).abs().max().item<double>() < 0.01);
    CHECK((weights > 0.003).sum(1).max().item<int>() == 2);
    CHECK((weights.mean(0) - 1.0 / 3).abs().max().item<double>() < 0.08);

    settings = certain();
    random = randoms(1, 6);
    settings.smoothstep = "never";
    settings.lowest_gamma = settings.highest_gamma = 1;
    photos = render_random(settings, torch::full({ 1, 3, 4, 4 }, 0.004f), torch::ones({ 1, 3 }),
                           torch::eye(3).view({ 1, 1, 3, 3 }), random);
    CHECK(photos.max().item<double>() == doctest::Approx(0.1).epsilon(0.03)); // a gain of 25, not of 200
}

TEST_CASE("every option changes the picture, and none gives a number that is none")
{
    const auto render = [](const RandomIspSettings& settings, const torch::Tensor& raw) {
        auto random = randoms(4, 7);
        return render_random(settings, raw, torch::full({ 4, 3 }, 1.5f), test_matrix().view({ 1, 1, 3, 3 }), random);
    };
    torch::manual_seed(4);
    const auto raw = torch::rand({ 4, 3, 32, 32 });
    const auto usual = render({}, raw);
    RandomIspSettings all;
    for (double RandomIspSettings::*share :
         { &RandomIspSettings::average_metering, &RandomIspSettings::linear_saturation, &RandomIspSettings::shoulder,
           &RandomIspSettings::local_contrast, &RandomIspSettings::channel_curves }) {
        RandomIspSettings one;
        one.*share = all.*share = 1;
        CHECK((render(one, raw) - usual).abs().max().item<double>() > 0.02);
    }
    for (const auto& image : { torch::zeros({ 4, 3, 32, 32 }), torch::ones({ 4, 3, 32, 32 }), raw }) {
        const auto photos = render(all, image);
        CHECK(torch::isfinite(photos).all().item<bool>());
        CHECK(photos.min().item<double>() >= 0);
        CHECK(photos.max().item<double>() <= 1);
    }
}
