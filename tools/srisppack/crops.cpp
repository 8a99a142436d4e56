// SPDX-License-Identifier: Apache-2.0
#include "crops.h"

#include <algorithm>
#include <cmath>

#include "base/seeded_hash.h"

namespace srisp::tool {

namespace {

constexpr double kSmallestShare = 0.5;
// A crop that may only be 98 … 100 % of the image would show it once more.
constexpr double kLargestSmallestShare = 0.9;

/// In [0,1).
double chance(std::uint64_t seed, const std::string& text)
{
    return double(seeded_hash(seed, text) >> 11) * 0x1p-53;
}

} // namespace

std::vector<Roi> choose_crops(int width, int height, int size, int count, std::uint64_t seed, const std::string& name)
{
    std::vector<Roi> crops = { { 0, width, 0, height } };
    const double least = std::max(kSmallestShare, double(size) / std::min(width, height));
    if (least > kLargestSmallestShare)
        return crops;
    for (int i = 0; i < count; ++i) {
        const std::string draw = name + "/" + std::to_string(i);
        const double share = least + (1 - least) * chance(seed, draw + " share");
        const int w = std::max(size, int(std::lround(share * width))),
                  h = std::max(size, int(std::lround(share * height)));
        const int x = int(chance(seed, draw + " x") * (width - w + 1)),
                  y = int(chance(seed, draw + " y") * (height - h + 1));
        crops.push_back({ x, x + w, y, y + h });
    }
    return crops;
}

std::array<float, 4> relative_crop(const Roi& crop, int width, int height)
{
    return { float(crop.x0) / float(width), float(crop.y0) / float(height), float(crop.x1) / float(width),
             float(crop.y1) / float(height) };
}

Roi stored_crop(const Roi& upright, int width, int height, int orientation)
{
    // As oriented_square: 5 … 8 swap the axes, some run backwards.
    const bool swap = orientation >= 5 && orientation <= 8;
    const bool flip_x = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool flip_y = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    Roi stored = swap ? Roi{ upright.y0, upright.y1, upright.x0, upright.x1 } : upright;
    if (flip_x)
        stored = { width - stored.x1, width - stored.x0, stored.y0, stored.y1 };
    if (flip_y)
        stored = { stored.x0, stored.x1, height - stored.y1, height - stored.y0 };
    return stored;
}

void append_pixels(const std::vector<float>& rgb, std::vector<std::uint16_t>& pixels)
{
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t i = channel; i < rgb.size(); i += 3)
            pixels.push_back(std::uint16_t(std::lround(std::clamp(rgb[i], 0.0f, 1.0f) * 65535.0f)));
}

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
