// SPDX-License-Identifier: Apache-2.0
#include "rendering/upi.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rendering/rendering_steps.h"
#include "rendering/test_rendering.h"

namespace srisp {

UpiParameters draw_upi(Random random)
{
    const std::vector<Matrix3>& cameras = dnd_rgb_to_camera();
    std::vector<double> weights;
    double sum = 0;
    for (std::size_t k = 0; k < cameras.size(); ++k)
        sum += weights.emplace_back(random.uniform(1e-3, 1));
    UpiParameters parameters{};
    for (std::size_t k = 0; k < cameras.size(); ++k)
        for (std::size_t i = 0; i < 9; ++i)
            parameters.to_camera[i] += float(weights[k] / sum) * cameras[k][i];
    const double gain = 1 / (0.8 + 0.1 * random.normal());
    const double red = gain * random.uniform(1.9, 2.4), blue = gain * random.uniform(1.5, 1.9);
    parameters.gains = { float(red), float(gain), float(blue) };
    return parameters;
}

Vector3 unprocessed_by_upi(const UpiParameters& parameters, const Vector3& photo)
{
    constexpr float kGamma = 2.2f;
    Vector3 v;
    for (std::size_t c = 0; c < 3; ++c) // the inverse of 3v² − 2v³, then of the gamma
        v[c] = std::pow(std::max(0.5f - std::sin(std::asin(1 - 2 * unit_clamped(photo[c])) / 3), 1e-8f), kGamma);
    v = product(parameters.to_camera, v);
    // Highlights keep what gains above 1 would take from them.
    const float kept = std::pow(unit_clamped(((v[0] + v[1] + v[2]) / 3 - 0.9f) * 10), 2.0f);
    for (std::size_t c = 0; c < 3; ++c) {
        const float scale = 1 / parameters.gains[c];
        v[c] = unit_clamped(v[c] * scale + v[c] * kept * std::max(1 - scale, 0.0f));
    }
    return v;
}

} // namespace srisp
