// SPDX-License-Identifier: Apache-2.0
#include "kernels/tone_table.h"

namespace srisp {

void ToneTable::fill_plane(const PixelToneMap& tone_map, int red)
{
    constexpr float step = 1.0f / (kSide - 1);
    float row[3][kSide + kRowSlack] = {};
    const Planes planes{ row[0], kSide + kRowSlack };
    float* point = m_values.get() + std::size_t(red) * kSide * kSide * kStride;
    for (int green = 0; green < kSide; ++green) {
        for (int blue = 0; blue < kSide; ++blue) {
            row[0][blue] = red * step;
            row[1][blue] = green * step;
            row[2][blue] = blue * step;
        }
        tone_map_pixels(tone_map, planes, planes, kSide);
        for (int blue = 0; blue < kSide; ++blue, point += kStride) {
            for (int c = 0; c < 3; ++c)
                point[c] = row[c][blue];
            point[3] = 0;
        }
    }
}

} // namespace srisp
