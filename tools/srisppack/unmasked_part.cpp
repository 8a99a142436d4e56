// SPDX-License-Identifier: Apache-2.0
#include "unmasked_part.h"

#include <algorithm>

namespace srisp::tool {

static std::vector<bool> masked_pixels(const std::vector<float>& rgb, int width, int height)
{
    const auto is_zero = [&](int x, int y) {
        const float* pixel = rgb.data() + (std::ptrdiff_t(y) * width + x) * 3;
        return pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0;
    };
    std::vector<bool> masked(std::size_t(width) * height);
    for (int y = 0; y + 3 <= height; ++y)
        for (int x = 0; x + 3 <= width; ++x) {
            bool block = true;
            for (int i = 0; i < 9 && block; ++i)
                block = is_zero(x + i % 3, y + i / 3);
            for (int i = 0; i < 9 && block; ++i)
                masked[std::size_t(y + i / 3) * width + x + i % 3] = true;
        }
    return masked;
}

Roi largest_unmasked_part(const std::vector<float>& rgb, int width, int height)
{
    const std::vector<bool> masked = masked_pixels(rgb, width, height);
    std::vector<int> clear(width); // rows up to this one without a masked pixel, per column
    Roi best{ 0, 0, 0, 0 };
    const auto area = [](const Roi& roi) { return (roi.x1 - roi.x0) * (roi.y1 - roi.y0); };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            clear[x] = masked[std::size_t(y) * width + x] ? 0 : clear[x] + 1;
        for (int x0 = 0; x0 < width; ++x0)
            for (int x1 = x0, rows = clear[x0]; x1 < width && rows > 0; ++x1) {
                rows = std::min(rows, clear[x1]);
                if (const Roi part{ x0, x1 + 1, y + 1 - rows, y + 1 }; area(part) > area(best))
                    best = part;
            }
    }
    return best;
}

} // namespace srisp::tool
