// SPDX-License-Identifier: Apache-2.0
#include "kernels/tone_table.h"

namespace srisp {

// All points of a plane at once, of which few share a block with what lies behind them: a row alone fills one block and
// a half.
void ToneTable::fill_plane(const PixelToneMap& tone_map, int red)
{
    constexpr float step = 1.0f / (kSide - 1);
    constexpr std::size_t points = std::size_t(kSide) * kSide, stride = points + kRowSlack;
    float colors[3][stride] = {};
    for (int green = 0, at = 0; green < kSide; ++green)
        for (int blue = 0; blue < kSide; ++blue, ++at) {
            colors[0][at] = red * step;
            colors[1][at] = green * step;
            colors[2][at] = blue * step;
        }
    const Planes planes{ colors[0], stride };
    tone_map_pixels(tone_map, planes, planes, points);
    float* point = m_values.get() + red * points * kStride;
    for (std::size_t at = 0; at < points; ++at, point += kStride) {
        for (int c = 0; c < 3; ++c)
            point[c] = colors[c][at];
        point[3] = 0;
    }
}

} // namespace srisp
