// SPDX-License-Identifier: Apache-2.0
#include "train/tensors/resize.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

using namespace srisp::train;

namespace {

/// The definition: mean of the input under an output cell, one plane, in double.
double mean_under(const torch::Tensor& plane, double left, double top, double right, double bottom)
{
    const auto pixels = plane.accessor<float, 2>();
    double sum = 0;
    for (std::int64_t y = 0; y < plane.size(0); ++y)
        for (std::int64_t x = 0; x < plane.size(1); ++x) {
            const double wide = std::min(right, x + 1.0) - std::max(left, double(x));
            const double high = std::min(bottom, y + 1.0) - std::max(top, double(y));
            if (wide > 0 && high > 0)
                sum += wide * high * pixels[y][x];
        }
    return sum / ((right - left) * (bottom - top));
}

double largest_difference(const torch::Tensor& images, const torch::Tensor& resized, const std::vector<Window>& windows)
{
    double largest = 0;
    const auto height = resized.size(2), width = resized.size(3);
    for (std::int64_t n = 0; n < images.size(0); ++n)
        for (std::int64_t c = 0; c < images.size(1); ++c)
            for (std::int64_t y = 0; y < height; ++y)
                for (std::int64_t x = 0; x < width; ++x) {
                    const Window& w = windows[n];
                    const double across = (w.right - w.left) * images.size(3),
                                 down = (w.bottom - w.top) * images.size(2);
                    const double left = w.left * images.size(3), top = w.top * images.size(2);
                    const double expected = mean_under(images[n][c], left + across * x / width, top + down * y / height,
                                                       left + across * (x + 1) / width, top + down * (y + 1) / height);
                    largest = std::max(largest, std::abs(expected - resized[n][c][y][x].item<float>()));
                }
    return largest;
}

} // namespace

TEST_CASE("an area average equals the scalar double loop, when shrinking, when enlarging and at its own size")
{
    torch::manual_seed(1);
    const auto images = torch::rand({ 2, 3, 23, 17 });
    const std::vector<Window> whole(2);
    for (const auto& [height, width] : { std::pair(8, 5), std::pair(23, 17), std::pair(31, 40), std::pair(1, 1),
                                         std::pair(23, 4), std::pair(50, 17) }) {
        INFO(height, " × ", width);
        CHECK(largest_difference(images, area_resize(images, height, width), whole) < 1e-6);
    }
    CHECK(torch::equal(area_resize(images, 23, 17), images));
}

TEST_CASE("each image is cropped by its own window, fractions of pixels counted")
{
    torch::manual_seed(2);
    const auto images = torch::rand({ 3, 3, 20, 31 });
    const std::vector<Window> windows = { { 0.1, 0.2, 0.73, 0.9 }, { 0, 0, 0.5, 1 }, { 0.999, 0, 1, 0.01 } };
    CHECK(largest_difference(images, area_crop(images, windows, 9, 7), windows) < 1e-6);
    CHECK(largest_difference(images, area_crop(images, windows, 40, 33), windows) < 1e-6);
    CHECK(torch::allclose(area_crop(images, std::vector<Window>(3), 11, 12), area_resize(images, 11, 12), 0, 1e-6));
}
