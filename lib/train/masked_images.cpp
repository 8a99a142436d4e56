// SPDX-License-Identifier: Apache-2.0
#include "masked_images.h"

#include <array>

namespace srisp::train {

namespace {

constexpr int kGrid = 16;
constexpr double kMostZeros = 0.005, kSmallestPart = 0.6;

/// [row][column]: the part of the image above and left of that corner of the grid that is zero.
using ZeroSums = std::array<std::array<double, kGrid + 1>, kGrid + 1>;

ZeroSums zero_sums(const torch::Tensor& raw)
{
    const auto zero = (raw == 0).all(0).to(torch::kFloat32).unsqueeze(0).unsqueeze(0);
    const auto cells = area_resize(zero, kGrid, kGrid).to(torch::kDouble).squeeze(0).squeeze(0).contiguous();
    const double* cell = cells.data_ptr<double>();
    ZeroSums sums{};
    for (int y = 0; y < kGrid; ++y)
        for (int x = 0; x < kGrid; ++x)
            sums[y + 1][x + 1] = sums[y][x + 1] + sums[y + 1][x] - sums[y][x] + cell[y * kGrid + x] / (kGrid * kGrid);
    return sums;
}

} // namespace

std::optional<Window> unmasked_window(const torch::Tensor& raw)
{
    const ZeroSums sums = zero_sums(raw);
    std::optional<Window> best;
    double best_area = kSmallestPart;
    for (int top = 0; top < kGrid; ++top)
        for (int bottom = top + 1; bottom <= kGrid; ++bottom)
            for (int left = 0; left < kGrid; ++left)
                for (int right = kGrid; right > left; --right) {
                    const double area = double(bottom - top) * (right - left) / (kGrid * kGrid);
                    const double zeros = sums[bottom][right] - sums[top][right] - sums[bottom][left] + sums[top][left];
                    if (area >= best_area && (!best || area > best_area) && zeros <= kMostZeros * area) {
                        best = Window{ double(left) / kGrid, double(top) / kGrid, double(right) / kGrid,
                                       double(bottom) / kGrid };
                        best_area = area;
                    }
                }
    return best;
}

} // namespace srisp::train
