// SPDX-License-Identifier: Apache-2.0
#include "camera/light.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace srisp {

namespace {

constexpr double kTintScale = 3000;

/// A place in CIE 1960 uv.
struct Uv {
    double u, v;
};

Uv locus(double t)
{
    return {
        (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) / (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t),
        (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) / (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t)
    };
}

/// Across the locus at t, of length 1, to greener lights.
Uv across(double t)
{
    const Uv cooler = locus(t * 1.001), warmer = locus(t / 1.001);
    const double du = cooler.u - warmer.u, dv = cooler.v - warmer.v, length = std::hypot(du, dv);
    return { dv / length, -du / length };
}

Uv uv_of(const Xy& xy)
{
    const double scale = -2.0 * xy[0] + 12.0 * xy[1] + 3;
    return { 4 * xy[0] / scale, 6 * xy[1] / scale };
}

Xy xy_of_uv(const Uv& uv)
{
    const double scale = 2 * uv.u - 8 * uv.v + 4;
    return { float(3 * uv.u / scale), float(2 * uv.v / scale) };
}

} // namespace

Xy xy_of_light(const Light& light)
{
    const Uv on = locus(light.temperature), off = across(light.temperature);
    const double distance = light.tint / kTintScale;
    return xy_of_uv({ on.u + off.u * distance, on.v + off.v * distance });
}

Light light_of_xy(const Xy& xy)
{
    const Uv uv = uv_of(xy);
    // Along the locus, in reciprocal temperature: the nearest point has nothing left along it.
    double low = 1 / double(kHighestTemperature), high = 1 / double(kLowestTemperature);
    const auto beyond = [&](double reciprocal) {
        const Uv on = locus(1 / reciprocal), off = across(1 / reciprocal);
        return (uv.u - on.u) * -off.v + (uv.v - on.v) * off.u > 0; // (−v, u) points to cooler lights
    };
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (beyond(middle) ? high : low) = middle;
    }
    const double temperature = 2 / (low + high);
    const Uv on = locus(temperature), off = across(temperature);
    const double tint = ((uv.u - on.u) * off.u + (uv.v - on.v) * off.v) * kTintScale;
    return { float(temperature), float(tint) };
}

const Xy* xy_of_light_source(int code)
{
    static const Xy kA{ 0.44757f, 0.40745f }, kB{ 0.34842f, 0.35161f }, kC{ 0.31006f, 0.31616f },
        kD55{ 0.33242f, 0.34743f }, kD75{ 0.29902f, 0.31485f };
    const auto planck = [](float temperature) { return xy_of_light({ temperature, 0 }); };
    // Ranges of fluorescent lamps: their middles [Exif 2.3, LightSource].
    static const std::map<int, Xy> known = {
        { 1, kD55 },          { 2, planck(4150) },  { 3, kA },
        { 4, kD55 },          { 9, kD55 },          { 10, kD65 },
        { 11, kD75 },         { 12, planck(6400) }, { 13, planck(5050) },
        { 14, planck(4150) }, { 15, planck(3450) }, { 16, planck(2925) },
        { 17, kA },           { 18, kB },           { 19, kC },
        { 20, kD55 },         { 21, kD65 },         { 22, kD75 },
        { 23, kD50 },         { 24, planck(3200) },
    };
    const auto found = known.find(code);
    return found == known.end() ? nullptr : &found->second;
}

} // namespace srisp
