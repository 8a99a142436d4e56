// SPDX-License-Identifier: Apache-2.0
#include <srisp/neutral_rendition.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/matrix3.h"
#include "camera/camera_color.h"
#include "color/color_transform.h"

namespace srisp {

namespace {

constexpr float kBright = 0.97f, kBrightBecomes = 0.85f; // the middle of what auto exposure in training does [method 4]

float clamped01(float v)
{
    return std::clamp(v, 0.0f, 1.0f);
}

/// Means of R, G, B, kept from 0.
std::array<double, 3> means_of(const std::vector<float>& rgb)
{
    std::array<double, 3> sums{ 1e-6, 1e-6, 1e-6 };
    for (std::size_t i = 0; i < rgb.size(); ++i)
        sums[i % 3] += rgb[i];
    return sums;
}

} // namespace

void render_neutrally(std::vector<float>& rgb, const CameraFacts& facts)
{
    const std::array<float, 3> balance = white_balance_of(facts, means_of(rgb));
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
    const Matrix3 matrix = balanced_to_srgb(facts);
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
