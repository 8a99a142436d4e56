// SPDX-License-Identifier: Apache-2.0
#include "train/samples/camera_isp.h"

#include <cmath>

#include "train/samples/random_isp.h"
#include "train/tensors/color.h"

namespace srisp::train {

namespace {

/// Purposes of random numbers within a rendering.
enum Purpose { kBalance, kBrightness, kMatrix, kMix, kCurve, kWhite, kHue, kEncoding, kSaturation, kStyle, kPlain };

constexpr double kMiddleGrey = 0.18;

/// The light's gains with a camera's error, or with those for another light, [N, 3, 1, 1].
torch::Tensor balance_gains(const CameraIspSettings& settings, const torch::Tensor& white_balance,
                            const Randoms& randoms)
{
    auto errors = torch::ones({ white_balance.size(0), 3 });
    auto forks = fork(randoms, kBalance);
    for (std::size_t n = 0; n < forks.size(); ++n) {
        const double e = settings.balance_error;
        const double red = forks[n].uniform(1 - e, 1 + e), blue = forks[n].uniform(1 - e, 1 + e);
        const bool has_cast = forks[n].chance(settings.cast);
        const double cast = forks[n].uniform(settings.coolest_cast, settings.warmest_cast);
        errors[n][0] = red * (has_cast ? std::exp(cast) : 1);
        errors[n][2] = blue * (has_cast ? std::exp(-cast) : 1);
    }
    return (white_balance * errors.to(white_balance.device())).unsqueeze(2).unsqueeze(3);
}

/// [N, 3, 3]
torch::Tensor chosen_matrices(const CameraIspSettings& settings, const torch::Tensor& own, const torch::Tensor& others,
                              const Randoms& randoms)
{
    auto forks = fork(randoms, kMatrix);
    const auto other = per_image(forks, own.device(), [&](Random& r) { return r.chance(settings.other_matrix); });
    return torch::where(other.squeeze(3) > 0, mix_matrices(others, 3, fork(randoms, kMix)), own);
}

/// What brings the 99th percentile of the brightest channel to 1, where that is brighter: [N, 1, 1, 1].
torch::Tensor auto_brightness(const CameraIspSettings& settings, const torch::Tensor& linear, const Randoms& randoms)
{
    auto forks = fork(randoms, kBrightness);
    const auto has = per_image(forks, linear.device(), [&](Random& r) { return r.chance(settings.auto_brightness); });
    const auto white = row_quantile(linear.flatten(0, 1).flatten(1), 0.99).view({ -1, 3 }).amax(1);
    return torch::where(has > 0, (1 / white.clamp_min(1.0 / 64)).clamp_min(1).view({ -1, 1, 1, 1 }), 1.0);
}

/// The first draw of a camera's curve.
bool draw_curved(const CameraIspSettings& settings, Random& curve)
{
    return curve.chance(settings.curved);
}

/// Each camera's gain, or 1 where it renders plainly: [N, 1, 1, 1].
torch::Tensor gains_used(const CameraIspSettings& settings, const torch::Tensor& gains, const Randoms& randoms)
{
    auto curves = fork(randoms, kCurve), plain = fork(randoms, kPlain);
    const auto used = gains.to(torch::kCPU).clone().view({ -1, 1, 1, 1 });
    for (std::size_t n = 0; n < curves.size(); ++n)
        if (!draw_curved(settings, curves[n]) && plain[n].chance(settings.plain))
            used[n] = 1;
    return used;
}

/// Tone curves through (0, 0), middle grey and (1, 1): x^c (1 + k) / (x^c + k), which is steepest in between. Linear
/// where an image has none.
struct ToneCurves {
    torch::Tensor exponent, k, has; ///< [N, 1, 1, 1]

    ToneCurves(const CameraIspSettings& settings, const torch::Tensor& middle_in, const torch::Device& device,
               const Randoms& randoms)
    {
        auto forks = fork(randoms, kCurve);
        has = torch::empty({ middle_in.size(0), 1, 1, 1 });
        exponent = has.clone();
        k = has.clone();
        for (std::size_t n = 0; n < forks.size(); ++n) {
            Random& random = forks[n];
            const bool curved = draw_curved(settings, random);
            const double brightened =
                kMiddleGrey * std::exp(random.uniform(settings.lowest_middle, settings.highest_middle));
            const double c = random.uniform(settings.lowest_contrast, settings.highest_contrast);
            // Below x^c the curve would have to bend the other way.
            const double x = std::pow(middle_in[n].item<double>(), c);
            const double middle = std::min(std::max(brightened, x * 1.02), 0.9);
            has[n] = curved ? 1.0 : 0.0;
            exponent[n] = c;
            k[n] = x * (1 - middle) / std::max(middle - x, 1e-6);
        }
        has = has.to(device);
        exponent = exponent.to(device);
        k = k.to(device);
    }

    torch::Tensor operator()(const torch::Tensor& x) const
    {
        const auto v = fast_power(x.clamp_min(1e-8), exponent);
        return torch::where(has > 0, v * (1 + k) / (v + k), x);
    }
};

/// Linear sRGB ≥ 0, 1 where the sensor with its gain of `gains` clips at most, to display linear in [0, 1].
torch::Tensor tone_mapped(const CameraIspSettings& settings, const torch::Tensor& linear, const torch::Tensor& gains,
                          const Randoms& randoms)
{
    auto whites = fork(randoms, kWhite), hues = fork(randoms, kHue);
    // What becomes white: 1, or what the gain makes of the sensor's white, or between them.
    const auto part = per_image(whites, torch::kCPU, [&](Random& r) {
        const bool rolled_off = r.chance(settings.rolled_off);
        const double held = r.uniform();
        return rolled_off ? held : 0;
    });
    const auto white = gains.to(torch::kCPU).view({ -1, 1, 1, 1 }).clamp_min(1).pow(part);
    const ToneCurves curves(settings, (kMiddleGrey / white).flatten(), linear.device(), randoms);
    const auto at_white = torch::where(curves.has > 0, white.to(linear.device()), 1.0);
    const auto v = (linear / at_white).clamp_min(0);
    const auto per_channel = curves(v.clamp_max(1));
    const auto largest = v.amax(1, true).clamp_min(1e-6);
    const auto hue_kept = v / largest * curves(largest.clamp_max(1));
    const auto keeps = per_image(hues, linear.device(), [&](Random& r) { return r.chance(settings.keeps_hue); });
    return torch::where(keeps > 0, hue_kept, per_channel).clamp(0, 1);
}

/// Display linear to display.
torch::Tensor encoded(const CameraIspSettings& settings, const torch::Tensor& v, const Randoms& randoms)
{
    auto forks = fork(randoms, kEncoding);
    const auto drawn = per_image(forks, torch::kCPU, [&](Random& r) {
        const double kind = r.uniform(), gamma = r.uniform(settings.lowest_gamma, settings.highest_gamma);
        return kind < settings.srgb ? 0 : (kind < settings.srgb + settings.bt709 ? -1 : gamma);
    });
    const auto kind = drawn.to(v.device());
    const auto safe = v.clamp_min(1e-8);
    // ITU-R BT.709
    const auto bt709 = torch::where(v < 0.018, 4.5 * v, 1.099 * safe.pow(0.45) - 0.099);
    return torch::where(kind > 0, fast_power(safe, 1 / kind.clamp_min(1)),
                        torch::where(kind < 0, bt709, srgb_encoded(v)));
}

} // namespace

double draw_camera_gain(const CameraIspSettings& settings, Random random)
{
    return settings.gain * std::exp(settings.gain_spread * random.normal());
}

torch::Tensor render_camera(const CameraIspSettings& settings, const torch::Tensor& raw,
                            const torch::Tensor& white_balance, const torch::Tensor& color, const torch::Tensor& others,
                            const torch::Tensor& gains, const Randoms& randoms)
{
    const auto device = raw.device();
    const auto gain = gains_used(settings, gains, randoms).to(device);
    // What the sensor clipped is grey.
    const auto balanced = (raw * balance_gains(settings, white_balance.to(device), randoms)).clamp_max_(1);
    const auto matrices = chosen_matrices(settings, color.to(device), others.to(device), randoms);
    auto linear = transform_colors(matrices, balanced).clamp_min_(0) * gain;
    const auto brightening = auto_brightness(settings, linear, randoms);
    linear = linear * brightening;
    auto v = tone_mapped(settings, linear, gain * brightening, randoms);
    auto saturations = fork(randoms, kSaturation), styles = fork(randoms, kStyle);
    const auto saturation = per_image(saturations, device, [&](Random& r) {
        return r.uniform(settings.lowest_saturation, settings.highest_saturation);
    });
    v = torch::lerp(luminance(v), v, saturation).clamp_(0, 1);
    const auto style =
        per_image(styles, device, [&](Random& r) { return r.uniform(settings.lowest_style, settings.highest_style); });
    return eight_bit(smoothstep(encoded(settings, v, randoms), style).clamp_(0, 1));
}

} // namespace srisp::train
