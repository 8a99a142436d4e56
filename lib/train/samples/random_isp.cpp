// SPDX-License-Identifier: Apache-2.0
#include "train/samples/random_isp.h"

#include <algorithm>
#include <cmath>

#include "train/tensors/color.h"
#include "train/tensors/resize.h"

namespace srisp::train {

namespace {

/// Purposes of random numbers within a rendering.
enum Purpose { kBalance, kExposure, kMatrix, kSaturation, kShoulder, kGamma, kSmoothstep, kContrast, kCurves };

/// A number for each image: drawn from the range for this share of images, `otherwise` for the rest.
torch::Tensor draw(const Randoms& randoms, Purpose purpose, const torch::Device& device, double share, double low,
                   double high, double otherwise)
{
    auto forks = fork(randoms, purpose);
    return per_image(forks, device, [=](Random& random) {
        const bool chosen = random.chance(share);
        const double value = random.uniform(low, high);
        return chosen ? value : otherwise;
    });
}

/// Gains [N, 3, 1, 1] that make the mean of each channel that of green. [method 4: without the darkest and brightest 5
/// %]
torch::Tensor grey_world(const torch::Tensor& raw)
{
    constexpr double kSmall = 1e-4; // keeps gains near 1 where there is no light
    const auto pixels = raw.flatten(2);
    const auto luma = 0.299 * pixels.select(1, 0) + 0.587 * pixels.select(1, 1) + 0.114 * pixels.select(1, 2);
    const auto ends = row_quantiles(luma, { 0.05, 0.95 });
    const auto kept = ((luma >= ends[0].unsqueeze(1)) & (luma <= ends[1].unsqueeze(1))).to(raw.dtype()).unsqueeze(1);
    const auto means = (pixels * kept).sum(2) / kept.sum(2) + kSmall;
    return (means.slice(1, 1, 2) / means).unsqueeze(2).unsqueeze(3);
}

/// Gains [N, 3, 1, 1]: the true ones, a little wrong, or grey world.
torch::Tensor balance_gains(const RandomIspSettings& settings, const torch::Tensor& raw,
                            const torch::Tensor& white_balance, const Randoms& randoms)
{
    const auto count = raw.size(0);
    const auto errors = torch::ones({ count, 3 }), is_true = torch::zeros({ count, 1, 1, 1 }, torch::kBool);
    auto forks = fork(randoms, kBalance);
    for (std::int64_t n = 0; n < count; ++n) {
        is_true[n][0][0][0] = forks[n].chance(settings.true_white_balance);
        const double e = settings.white_balance_error;
        errors[n][0] = forks[n].uniform(1 - e, 1 + e);
        errors[n][2] = forks[n].uniform(1 - e, 1 + e);
    }
    const auto gains = (white_balance.to(raw.device()) * errors.to(raw.device())).unsqueeze(2).unsqueeze(3);
    return torch::where(is_true.to(raw.device()), gains, grey_world(raw));
}

/// Exposure for the picture, or a random gain. [method 4: auto exposure]
torch::Tensor exposure_gains(const RandomIspSettings& settings, const torch::Tensor& balanced, const Randoms& randoms)
{
    const auto device = balanced.device();
    auto forks = fork(randoms, kExposure);
    std::vector<double> fixed, percentile, average;
    for (Random& random : forks) {
        const bool automatic = random.chance(settings.auto_exposure),
                   by_mean = random.chance(settings.average_metering);
        const double gain = random.uniform(settings.lowest_gain, settings.highest_gain);
        const double target = random.uniform(settings.lowest_target, settings.highest_target);
        const double mean = random.log_uniform(settings.lowest_average, settings.highest_average);
        fixed.push_back(automatic ? 0 : gain);
        percentile.push_back(automatic && !by_mean ? target : 0);
        average.push_back(automatic && by_mean ? mean : 0);
    }
    const auto column = [&](const std::vector<double>& values) {
        return torch::tensor(values, torch::kFloat32).to(device);
    };
    const auto grey = balanced.mean(1).flatten(1);
    const auto by_picture = column(percentile) / row_quantile(grey, 0.97).clamp_min(1e-6) +
                            column(average) / grey.clamp_max(1).mean(1).clamp_min(1e-6);
    const auto gain = column(fixed);
    return torch::where(gain > 0, gain, by_picture.clamp(0.5, 25)).view({ -1, 1, 1, 1 });
}

/// Values above `start` approach 1 instead of being cut there, with the slope 1 at the start.
torch::Tensor roll_off(const torch::Tensor& v, const torch::Tensor& start)
{
    const auto room = 1 - start;
    return torch::where(v > start, 1 - room * room / (v - start + room), v);
}

/// Adds a part of each pixel's difference to its neighbourhood's luma, a quarter of the image wide.
torch::Tensor add_local_contrast(const torch::Tensor& v, const torch::Tensor& strength)
{
    const auto luma = (0.299 * v.select(1, 0) + 0.587 * v.select(1, 1) + 0.114 * v.select(1, 2)).unsqueeze(1);
    const auto coarse = area_resize(luma, 8, 8);
    return v + strength * (luma - enlarge(coarse, v.size(2), v.size(3)));
}

/// Bends each channel by its own amount.
torch::Tensor bend_channels(const RandomIspSettings& settings, const torch::Tensor& v, const Randoms& randoms)
{
    auto bends = torch::zeros({ v.size(0), 3, 1, 1 });
    auto forks = fork(randoms, kCurves);
    for (std::int64_t n = 0; n < v.size(0); ++n) {
        const bool chosen = forks[n].chance(settings.channel_curves);
        for (int c = 0; c < 3; ++c)
            bends[n][c][0][0] = chosen ? forks[n].uniform(-settings.channel_bend, settings.channel_bend) : 0.0;
    }
    return v + bends.to(v.device()) * v * (1 - v);
}

/// What comes after the colour matrix: linear sRGB, not clipped yet, to display.
torch::Tensor encode(const RandomIspSettings& settings, torch::Tensor v, const Randoms& randoms)
{
    const auto device = v.device();
    if (settings.linear_saturation > 0) {
        const auto saturation = draw(randoms, kSaturation, device, settings.linear_saturation,
                                     settings.lowest_saturation, settings.highest_saturation, 1);
        v = torch::lerp(v.mean(1, true), v, saturation);
    }
    const auto gamma = draw(randoms, kGamma, device, 1, settings.lowest_gamma, settings.highest_gamma, 1);
    v = fast_power(v.clamp(0, 1), 1 / gamma);
    const double share =
        settings.smoothstep == "always" ? 1 : (settings.smoothstep == "random" ? settings.smoothstep_share : 0);
    const auto curved = draw(randoms, kSmoothstep, device, share, 1, 1, 0);
    v = smoothstep(v, curved);
    if (settings.local_contrast > 0)
        v = add_local_contrast(v, draw(randoms, kContrast, device, settings.local_contrast, settings.lowest_contrast,
                                       settings.highest_contrast, 0));
    if (settings.channel_curves > 0)
        v = bend_channels(settings, v.clamp(0, 1), randoms);
    return eight_bit(v.clamp_(0, 1));
}

} // namespace

torch::Tensor mix_matrices(const torch::Tensor& candidates, int mixed, const Randoms& randoms)
{
    const auto count = static_cast<std::int64_t>(randoms.size()), available = candidates.size(1);
    auto weights = torch::zeros({ count, available });
    Randoms forks = randoms;
    for (std::int64_t n = 0; n < count; ++n) {
        // The first numbers of a random order, with weights drawn evenly over the simplex (normalised exponentials).
        std::vector<std::pair<double, std::int64_t>> order;
        for (std::int64_t k = 0; k < available; ++k)
            order.emplace_back(forks[n].uniform(), k);
        std::sort(order.begin(), order.end());
        for (std::int64_t k = 0; k < std::min<std::int64_t>(mixed, available); ++k)
            weights[n][order[k].second] = -std::log(1 - forks[n].uniform()) + 1e-9;
    }
    weights = (weights / weights.sum(1, true)).to(candidates.device());
    return (candidates * weights.unsqueeze(2).unsqueeze(3)).sum(1);
}

torch::Tensor render_random(const RandomIspSettings& settings, const torch::Tensor& raw,
                            const torch::Tensor& white_balance, const torch::Tensor& matrices, Randoms& randoms)
{
    auto v = raw * balance_gains(settings, raw, white_balance, randoms);
    if (settings.neutral_highlights)
        v.clamp_max_(1);
    v = v * exposure_gains(settings, v, randoms);
    if (settings.shoulder > 0) {
        // A start of 1 is clipping.
        const auto start = draw(randoms, kShoulder, raw.device(), settings.shoulder, settings.lowest_shoulder,
                                settings.highest_shoulder, 0.9999);
        v = roll_off(v, start);
    }
    const auto matrix = mix_matrices(matrices.to(raw.device()), settings.mixed_matrices, fork(randoms, kMatrix));
    return encode(settings, transform_colors(matrix, v.clamp(0, 1)), randoms);
}

torch::Tensor render_fixed(const torch::Tensor& raw, const torch::Tensor& white_balance, const torch::Tensor& matrix,
                           const torch::Tensor& target)
{
    const auto balanced = (raw * white_balance.to(raw.device()).unsqueeze(2).unsqueeze(3)).clamp_max_(1);
    const auto bright = row_quantile(balanced.mean(1).flatten(1), 0.97).clamp_min(1e-6);
    const auto gain = (target.to(raw.device()).flatten() / bright).clamp(1.0 / 64, 64).view({ -1, 1, 1, 1 });
    const auto linear = transform_colors(matrix, (balanced * gain).clamp(0, 1)).clamp(0, 1);
    return eight_bit(srgb_encoded(linear));
}

} // namespace srisp::train
