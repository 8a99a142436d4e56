// SPDX-License-Identifier: Apache-2.0
#include "train/samples/photo_inverse.h"

#include <cmath>

#include "train/tensors/color.h"
#include "train/tensors/resize.h"

namespace srisp::train {

namespace {

/// White becomes `white`, grey moves little, hue and saturation stay.
torch::Tensor expand_highlights(const torch::Tensor& linear, const torch::Tensor& white)
{
    const auto brightest = linear.amax(1, true);
    return linear / (1 - (1 - 1 / white) * brightest * brightest);
}

/// Takes a part of the differences between the sixteen parts of each image out of its brightness.
torch::Tensor flatten(const torch::Tensor& linear, const torch::Tensor& strength)
{
    const auto brightness = torch::adaptive_avg_pool2d(luminance(linear).clamp_min(1e-4).log(), { 4, 4 });
    const auto difference = brightness - brightness.mean({ 2, 3 }, true);
    return linear * (-strength * enlarge(difference, linear.size(2), linear.size(3))).exp();
}

/// Gives ln luminance a random distribution: (e^(skew z) − 1) / skew, Tukey's g distribution, over the normal quantile
/// z of each pixel's rank, with the image's own mean. Ranks come from a histogram over luminance^(1/2.2), interpolated.
torch::Tensor reshape_histogram(const torch::Tensor& linear, const torch::Tensor& spread, const torch::Tensor& skew,
                                const torch::Tensor& strength)
{
    constexpr int kBins = 256;
    constexpr double kDarkest = 1e-4;
    const auto count = linear.size(0), pixels = linear.size(2) * linear.size(3);
    const auto y = luminance(linear).reshape({ count, pixels }).clamp_min(kDarkest);
    const auto position = (y / y.amax(1, true)).pow(1 / 2.2) * (kBins - 1);
    const auto bin = position.floor().clamp(0, kBins - 2);
    const auto fraction = position - bin;
    const auto index = bin.to(torch::kLong);
    // Counts are whole numbers below 2^24: the sums are exact in any order.
    auto counts = torch::zeros({ count, kBins }, y.options());
    counts.scatter_add_(1, index, torch::ones_like(y));
    const auto rank = (counts.cumsum(1) - counts) / static_cast<double>(pixels); // at each bin's lower edge
    const auto z = (rank * (1 - 2e-3) + 1e-3).mul(2).sub(1).erfinv() * std::sqrt(2.0);
    const auto g = skew.reshape({ count, 1 });
    const auto bent = torch::where(g.abs() < 1e-3, z, torch::expm1(g * z) / g) * spread.reshape({ count, 1 });
    const auto target = bent.gather(1, index) * (1 - fraction) + bent.gather(1, index + 1) * fraction;
    const auto log_y = y.log();
    const auto moved = strength.reshape({ count, 1 }) * (target + log_y.mean(1, true) - log_y);
    return linear * moved.exp().reshape({ count, 1, linear.size(2), linear.size(3) });
}

} // namespace

torch::Tensor undo_rendering(const PhotoInverseSettings& settings, const torch::Tensor& photos, Randoms& randoms)
{
    const auto device = photos.device();
    // Every number is drawn for every image, used or not, so that one setting does not move the others' numbers.
    const auto with = [&](double probability, double low, double high, double otherwise) {
        return per_image(randoms, device, [=](Random& random) {
            const bool chosen = random.chance(probability);
            const double value = random.uniform(low, high);
            return chosen ? value : otherwise;
        });
    };
    const auto s_curve = with(settings.s_curve, settings.lowest_s_curve, settings.highest_s_curve, 0);
    const auto gamma = with(1, settings.lowest_gamma, settings.highest_gamma, 0);
    const auto white = with(settings.expansion, std::log(settings.lowest_white), std::log(settings.highest_white), 0);
    const auto strength = with(settings.histogram, settings.lowest_strength, settings.highest_strength, 0);
    const auto spread = with(1, settings.lowest_spread, settings.highest_spread, 0);
    const auto skew = with(1, settings.lowest_skew, settings.highest_skew, 0);
    const auto flattening = with(settings.flattening, settings.lowest_flattening, settings.highest_flattening, 0);
    const auto saturation = with(1, settings.lowest_saturation, settings.highest_saturation, 0);

    auto v = photos;
    if (settings.s_curve > 0)
        v = torch::lerp(v, inverse_smoothstep(v), s_curve);
    v = fast_power(v, gamma);
    if (settings.expansion > 0)
        v = expand_highlights(v, white.exp());
    if (settings.flattening > 0)
        v = flatten(v, flattening);
    if (settings.histogram > 0)
        v = reshape_histogram(v, spread, skew, strength);
    return torch::lerp(luminance(v), v, saturation).clamp_min_(0);
}

} // namespace srisp::train
