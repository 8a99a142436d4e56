// SPDX-License-Identifier: Apache-2.0
#include "photo/headroom.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "color/color_transform.h"

namespace srisp {

void apply_gain_map(const GainMap& gain_map, int y, int width, float* rgb, float* headroom)
{
    std::vector<float> light(std::size_t(width) * 3);
    std::transform(rgb, rgb + light.size(), light.begin(), srgb_decoded);
    gain_map.boosted(y, light.data(), light.data());
    for (int x = 0; x < width; ++x) {
        const float* const pixel = light.data() + std::size_t(x) * 3;
        headroom[x] = std::max({ 1.0f, pixel[0], pixel[1], pixel[2] });
        for (int c = 0; c < 3; ++c)
            rgb[std::size_t(x) * 3 + c] = srgb_encoded(pixel[c] / headroom[x]);
    }
}

void add_headroom(const float* headroom, std::int64_t pixels, float* linear)
{
    for (std::int64_t i = 0; i < pixels; ++i)
        for (int c = 0; c < 3; ++c)
            linear[i * 3 + c] *= headroom[i];
}

} // namespace srisp
