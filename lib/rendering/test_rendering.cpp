// SPDX-License-Identifier: Apache-2.0
#include "rendering/test_rendering.h"

#include <algorithm>
#include <cmath>

#include "rendering/rendering_steps.h"

namespace srisp {

TestRendering fixed_rendering(const RawScene& scene)
{
    constexpr float kTarget = 0.9f;
    const Vector3 balance = scene.white_balance;
    const Matrix3 color = scene.color;
    const float bright = quantile(of_pixels(scene.raw,
                                            [&](const Vector3& raw) {
                                                const Vector3 v = white_clipped(scaled(raw, balance));
                                                return (v[0] + v[1] + v[2]) / 3;
                                            }),
                                  0.97);
    const float gain = std::clamp(kTarget / std::max(bright, 1e-6f), 1 / 64.0f, 64.0f);
    return [=](const Vector3& raw) {
        const Vector3 v = white_clipped(scaled(raw, balance));
        const Vector3 linear =
            unit_clamped(product(color, unit_clamped(Vector3{ v[0] * gain, v[1] * gain, v[2] * gain })));
        return srgb_encoded(linear);
    };
}

void render(const TestRendering& rendering, ImageView raw, MutableImageView photo)
{
    for (int y = 0; y < raw.height; ++y)
        for (int x = 0; x < raw.width; ++x) {
            const float* p = raw.pixel(x, y);
            const Vector3 v = rendering({ p[0], p[1], p[2] });
            for (int c = 0; c < 3; ++c)
                photo.pixel(x, y)[c] = std::floor(unit_clamped(v[c]) * 255 + 0.5f) / 255;
        }
}

static std::vector<Matrix3> dnd_matrices()
{
    // XYZ → camera; numbers as in method.md, section 4.
    constexpr Matrix3 kXyzToCamera[] = {
        { 1.0234f, -0.2969f, -0.2266f, -0.5625f, 1.6328f, -0.0469f, -0.0703f, 0.2188f, 0.6406f },
        { 0.4913f, -0.0541f, -0.0202f, -0.6130f, 1.3513f, 0.2906f, -0.1564f, 0.2151f, 0.7183f },
        { 0.8380f, -0.2630f, -0.0639f, -0.2887f, 1.0725f, 0.2496f, -0.0627f, 0.1427f, 0.5438f },
        { 0.6596f, -0.2079f, -0.0562f, -0.4782f, 1.3016f, 0.1933f, -0.0970f, 0.1581f, 0.5181f }
    };
    std::vector<Matrix3> result;
    for (const Matrix3& matrix : kXyzToCamera)
        result.push_back(row_normalized(product(matrix, kSrgbToXyz)));
    return result;
}

const std::vector<Matrix3>& dnd_rgb_to_camera()
{
    static const std::vector<Matrix3> matrices = dnd_matrices();
    return matrices;
}

const std::vector<Matrix3>& dnd_camera_to_rgb()
{
    static const std::vector<Matrix3> matrices = [] {
        std::vector<Matrix3> inverses = dnd_matrices();
        for (Matrix3& matrix : inverses)
            matrix = inverse(matrix);
        return inverses;
    }();
    return matrices;
}

} // namespace srisp
