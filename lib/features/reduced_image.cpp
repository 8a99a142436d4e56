// SPDX-License-Identifier: Apache-2.0
#include "features/reduced_image.h"

#include <algorithm>
#include <cstddef>

namespace srisp {

namespace {

constexpr int kSide = 64; // of the reduced plane, about

std::vector<float> block_means(const PlanarImage& image, int channel)
{
    const float* const plane = image.planes.plane(channel);
    const int height = image.height, width = image.width;
    const int rows = std::max(1, height / kSide), columns = std::max(1, width / kSide);
    std::vector<float> means;
    means.reserve(static_cast<std::size_t>(height / rows) * (width / columns));
    for (int y = 0; y + rows <= height; y += rows)
        for (int x = 0; x + columns <= width; x += columns) {
            double sum = 0;
            for (int dy = 0; dy < rows; ++dy)
                for (int dx = 0; dx < columns; ++dx)
                    sum += plane[static_cast<std::ptrdiff_t>(y + dy) * width + x + dx];
            means.push_back(static_cast<float>(sum / (rows * columns)));
        }
    return means;
}

} // namespace

ReducedImage reduced(const PlanarImage& image)
{
    return { block_means(image, 0), block_means(image, 1), block_means(image, 2) };
}

} // namespace srisp
