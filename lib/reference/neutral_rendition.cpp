// SPDX-License-Identifier: Apache-2.0
#include <srisp/neutral_rendition.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/matrix3.h"
#include "color/color_transform.h"

namespace srisp {

namespace {

constexpr float kBright = 0.97f, kBrightBecomes = 0.85f; // the middle of what auto exposure in training does [method 4]

float clamped01(float v)
{
    return std::clamp(v, 0.0f, 1.0f);
}

std::array<float, 3> white_balance(const std::vector<float>& rgb, const CameraFacts& facts)
{
    std::array<float, 3> neutral = facts.as_shot_neutral;
    if (*std::min_element(neutral.begin(), neutral.end()) <= 0) {
        std::array<double, 3> sum{ 1e-6, 1e-6, 1e-6 };
        for (std::size_t i = 0; i < rgb.size(); ++i)
            sum[i % 3] += rgb[i];
        for (int c = 0; c < 3; ++c)
            neutral[c] = static_cast<float>(sum[c] / sum[1]);
    }
    return { neutral[1] / neutral[0], 1, neutral[1] / neutral[2] };
}

Matrix3 camera_to_srgb(const CameraFacts& facts)
{
    const CameraFacts::ColorMatrix* matrix = facts.daylight_matrix();
    const Matrix3 srgb_to_camera = matrix ? product(matrix->xyz_to_camera, kSrgbToXyz) : Matrix3{};
    if (!matrix || std::abs(determinant(srgb_to_camera)) < 1e-9)
        return { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    // Rows of sRGB → camera that sum to 1 take white to white; so does the inverse.
    return inverse(row_normalized(srgb_to_camera));
}

} // namespace

void render_neutrally(std::vector<float>& rgb, const CameraFacts& facts)
{
    const std::array<float, 3> balance = white_balance(rgb, facts);
    // What is clipped in the RAW is white: no channel goes beyond where the first one clips.
    const float clipped = *std::min_element(balance.begin(), balance.end());
    std::vector<float> means;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        for (std::size_t c = 0; c < 3; ++c)
            rgb[i + c] = std::min(rgb[i + c] * balance[c], clipped);
        means.push_back((rgb[i] + rgb[i + 1] + rgb[i + 2]) / 3);
    }
    if (means.empty())
        return;
    const auto bright = means.begin() + static_cast<std::ptrdiff_t>(kBright * (means.size() - 1));
    std::nth_element(means.begin(), bright, means.end());
    const float gain = kBrightBecomes / std::max(*bright, 1e-3f);
    const Matrix3 matrix = camera_to_srgb(facts);
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        const float camera[3] = { clamped01(gain * rgb[i]), clamped01(gain * rgb[i + 1]),
                                  clamped01(gain * rgb[i + 2]) };
        for (std::size_t c = 0; c < 3; ++c)
            rgb[i + c] = srgb_encoded(
                clamped01(matrix[c * 3] * camera[0] + matrix[c * 3 + 1] * camera[1] + matrix[c * 3 + 2] * camera[2]));
    }
}

Thumbnail neutral_rendition(const Reference& reference)
{
    Thumbnail picture = reference.thumbnail;
    render_neutrally(picture.rgb, reference.facts);
    return picture;
}

} // namespace srisp
