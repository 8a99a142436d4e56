// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "rendering/rendering_steps.h"
#include "rendering/test_rendering.h"

namespace srisp {

namespace {

/// Purposes of random numbers within a rendering: those of the trainer's ISP_rand (train/samples/random_isp.cpp), so
/// that one seed gives the same picture in both.
enum Purpose { kBalance, kExposure, kMatrix, kGamma = 5, kSmoothstep };

// Method.md section 4 and the second series of section 6.
constexpr double kTrueBalance = 0.5, kBalanceError = 0.04;
constexpr double kAutoExposure = 0.75, kLowestTarget = 0.5, kHighestTarget = 1.2, kLowestGain = 1, kHighestGain = 2;
constexpr float kLowestAutoGain = 0.5f, kHighestAutoGain = 25;
constexpr int kMixedMatrices = 3;
constexpr double kLowestGamma = 2.0, kHighestGamma = 3.2, kCurved = 0.4;

float luma(const Vector3& v)
{
    return 0.299f * v[0] + 0.587f * v[1] + 0.114f * v[2];
}

/// Gains that make the mean of each channel that of green, without the darkest and brightest 5 %. [method 4]
Vector3 grey_world(ImageView raw)
{
    constexpr double kSmall = 1e-4; // keeps gains near 1 where there is no light
    const std::vector<float> lumas = of_pixels(raw, luma);
    const float low = quantile(lumas, 0.05), high = quantile(lumas, 0.95);
    double sums[3] = {}, count = 0;
    for (int y = 0; y < raw.height; ++y)
        for (int x = 0; x < raw.width; ++x) {
            const float* p = raw.pixel(x, y);
            const float brightness = luma({ p[0], p[1], p[2] });
            if (brightness < low || brightness > high)
                continue;
            ++count;
            for (int c = 0; c < 3; ++c)
                sums[c] += p[c];
        }
    Vector3 gains;
    for (int c = 0; c < 3; ++c)
        gains[c] = float((sums[1] / count + kSmall) / (sums[c] / count + kSmall));
    return gains;
}

/// The true gains, a little wrong, or grey world.
Vector3 balance_gains(const RawScene& scene, Random random)
{
    const bool is_true = random.chance(kTrueBalance);
    const double red = random.uniform(1 - kBalanceError, 1 + kBalanceError);
    const double blue = random.uniform(1 - kBalanceError, 1 + kBalanceError);
    return is_true ? scaled(scene.white_balance, { float(red), 1, float(blue) }) : grey_world(scene.raw);
}

/// Exposure for the picture, or a random gain.
float exposure_gain(const RawScene& scene, const Vector3& balance, Random random)
{
    const bool automatic = random.chance(kAutoExposure);
    random.uniform(); // by the mean, which tests leave out
    const double gain = random.uniform(kLowestGain, kHighestGain);
    const double target = random.uniform(kLowestTarget, kHighestTarget);
    if (!automatic)
        return float(gain);
    const auto mean = [&](const Vector3& raw) {
        const Vector3 v = scaled(raw, balance);
        return (v[0] + v[1] + v[2]) / 3;
    };
    const float bright = quantile(of_pixels(scene.raw, mean), 0.97);
    return std::clamp(float(target) / std::max(bright, 1e-6f), kLowestAutoGain, kHighestAutoGain);
}

} // namespace

TestRendering random_rendering(const RawScene& scene, const std::vector<Matrix3>& matrices, const Random& random)
{
    const Vector3 balance = balance_gains(scene, random.fork(kBalance));
    const float gain = exposure_gain(scene, balance, random.fork(kExposure));
    const Matrix3 color = mixed_matrix(matrices, kMixedMatrices, random.fork(kMatrix));
    Random gammas = random.fork(kGamma), curves = random.fork(kSmoothstep);
    gammas.uniform(); // the trainer draws whether there is one
    const auto exponent = float(1 / gammas.uniform(kLowestGamma, kHighestGamma));
    const float curved = curves.chance(kCurved) ? 1 : 0;
    return [=](const Vector3& raw) {
        Vector3 v = scaled(raw, balance);
        v = unit_clamped(product(color, unit_clamped(Vector3{ v[0] * gain, v[1] * gain, v[2] * gain })));
        for (float& value : v)
            value = smoothstep(std::pow(value, exponent), curved);
        return v;
    };
}

} // namespace srisp
