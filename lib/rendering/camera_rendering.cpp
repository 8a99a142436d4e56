// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "rendering/rendering_steps.h"
#include "rendering/test_rendering.h"

namespace srisp {

namespace {

/// Purposes of random numbers within a rendering: those of the trainer's cameras (train/samples/camera_isp.cpp).
enum Purpose { kBalance, kBrightness, kMatrix, kMix, kCurve, kWhite, kHue, kEncoding, kSaturation, kStyle };

// The families of curves that converters and cameras use, and dcraw's way to brighten.
constexpr double kBalanceError = 0.04, kCast = 0.15, kCoolestCast = -0.3, kWarmestCast = 0.6;
constexpr double kGain = 1.3, kGainSpread = 0.3, kAutoBrightness = 0.15, kOtherMatrix = 0.3;
constexpr double kCurved = 0.75, kLowestMiddle = 0, kHighestMiddle = 1.2, kLowestContrast = 1, kHighestContrast = 1.6;
constexpr double kRolledOff = 0.5, kKeepsHue = 0.4;
constexpr double kSrgb = 0.55, kBt709 = 0.2, kLowestGamma = 1.8, kHighestGamma = 2.4;
constexpr double kLowestSaturation = 0.85, kHighestSaturation = 1.4, kLowestStyle = -0.2, kHighestStyle = 0.5;
constexpr double kMiddleGrey = 0.18;

/// The light's gains with a camera's error, or with those for another light.
Vector3 balance_gains(const Vector3& white_balance, Random random)
{
    const double red = random.uniform(1 - kBalanceError, 1 + kBalanceError);
    const double blue = random.uniform(1 - kBalanceError, 1 + kBalanceError);
    const bool has_cast = random.chance(kCast);
    const double cast = random.uniform(kCoolestCast, kWarmestCast);
    return scaled(white_balance,
                  { float(red * (has_cast ? std::exp(cast) : 1)), 1, float(blue * (has_cast ? std::exp(-cast) : 1)) });
}

/// Linear sRGB as the sensor recorded it, without a gain: 0 or more.
Vector3 developed(const Vector3& raw, const Vector3& balance, const Matrix3& color)
{
    Vector3 v = product(color, white_clipped(scaled(raw, balance)));
    for (float& value : v)
        value = std::max(value, 0.0f);
    return v;
}

/// What brings the 99th percentile of the brightest channel to 1, where that is brighter.
float auto_brightness(ImageView raw, const Vector3& balance, const Matrix3& color, float gain)
{
    float white = 0;
    for (std::size_t c = 0; c < 3; ++c)
        white = std::max(
            white,
            quantile(of_pixels(raw, [&](const Vector3& v) { return developed(v, balance, color)[c] * gain; }), 0.99));
    return std::max(1 / std::max(white, 1 / 64.0f), 1.0f);
}

/// A tone curve through (0, 0), middle grey and (1, 1): x^c (1 + k) / (x^c + k), which is steepest in between; or a
/// straight line.
struct ToneCurve {
    bool curved;
    float exponent, k;

    ToneCurve(double middle_in, Random random)
    {
        curved = random.chance(kCurved);
        const double brightened = kMiddleGrey * std::exp(random.uniform(kLowestMiddle, kHighestMiddle));
        const double c = random.uniform(kLowestContrast, kHighestContrast);
        // Below x^c the curve would have to bend the other way.
        const double x = std::pow(middle_in, c);
        const double middle = std::min(std::max(brightened, x * 1.02), 0.9);
        exponent = float(c);
        k = float(x * (1 - middle) / std::max(middle - x, 1e-6));
    }

    float operator()(float x) const
    {
        if (!curved)
            return x;
        const float v = std::pow(std::max(x, 1e-8f), exponent);
        return v * (1 + k) / (v + k);
    }
};

/// What becomes white: 1, or what the gain makes of the sensor's white, or between them.
double white_point(double gain, Random random)
{
    const bool rolled_off = random.chance(kRolledOff);
    const double held = random.uniform();
    return std::pow(std::max(gain, 1.0), rolled_off ? held : 0);
}

/// Display linear to display. `kind`: above 0 a plain gamma, 0 sRGB's encoding, below 0 BT.709's.
float encoded(float v, float kind)
{
    if (kind > 0)
        return std::pow(std::max(v, 1e-8f), 1 / kind);
    if (kind < 0)
        return v < 0.018f ? 4.5f * v : 1.099f * std::pow(v, 0.45f) - 0.099f;
    return float(srgb_curve(v));
}

float draw_encoding(Random random)
{
    const double kind = random.uniform(), gamma = random.uniform(kLowestGamma, kHighestGamma);
    return kind < kSrgb ? 0 : kind < kSrgb + kBt709 ? -1 : float(gamma);
}

Vector3 tone_mapped(const ToneCurve& curve, bool keeps_hue, float white, const Vector3& linear)
{
    const Vector3 v{ linear[0] / white, linear[1] / white, linear[2] / white };
    if (!keeps_hue)
        return unit_clamped(
            Vector3{ curve(std::min(v[0], 1.0f)), curve(std::min(v[1], 1.0f)), curve(std::min(v[2], 1.0f)) });
    const float largest = std::max({ v[0], v[1], v[2], 1e-6f });
    const float scale = curve(std::min(largest, 1.0f)) / largest;
    return unit_clamped(Vector3{ v[0] * scale, v[1] * scale, v[2] * scale });
}

} // namespace

double draw_camera_gain(Random random)
{
    return kGain * std::exp(kGainSpread * random.normal());
}

TestRendering camera_rendering(const RawScene& scene, const std::vector<Matrix3>& matrices, double camera_gain,
                               const Random& random)
{
    const Vector3 balance = balance_gains(scene.white_balance, random.fork(kBalance));
    const Matrix3 color =
        random.fork(kMatrix).chance(kOtherMatrix) ? mixed_matrix(matrices, 3, random.fork(kMix)) : scene.color;
    float gain = float(camera_gain);
    if (random.fork(kBrightness).chance(kAutoBrightness))
        gain *= auto_brightness(scene.raw, balance, color, gain);
    const double full_white = white_point(gain, random.fork(kWhite));
    const ToneCurve curve(kMiddleGrey / full_white, random.fork(kCurve));
    const float white = curve.curved ? float(full_white) : 1;
    const bool keeps_hue = random.fork(kHue).chance(kKeepsHue);
    const float encoding = draw_encoding(random.fork(kEncoding));
    const auto saturation = float(random.fork(kSaturation).uniform(kLowestSaturation, kHighestSaturation));
    const auto style = float(random.fork(kStyle).uniform(kLowestStyle, kHighestStyle));
    return [=](const Vector3& raw) {
        Vector3 v = developed(raw, balance, color);
        v = tone_mapped(curve, keeps_hue, white, { v[0] * gain, v[1] * gain, v[2] * gain });
        const float luminance = 0.2126f * v[0] + 0.7152f * v[1] + 0.0722f * v[2];
        for (float& value : v)
            value = smoothstep(encoded(unit_clamped(luminance + saturation * (value - luminance)), encoding), style);
        return unit_clamped(v);
    };
}

} // namespace srisp
