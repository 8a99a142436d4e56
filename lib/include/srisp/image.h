// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace srisp {

/// A view of three interleaved float32 channels (R, G, B adjacent); it owns nothing.
template<class Float> struct BasicImageView {
    Float* data;             ///< the R of pixel (0, 0)
    int width, height;       ///< pixels
    std::ptrdiff_t x_stride; ///< floats from a pixel to its right neighbour (3 for RGB, 4 inside RGBA)
    std::ptrdiff_t y_stride; ///< floats from a row to the next one

    Float* pixel(int x, int y) const { return data + x * x_stride + y * y_stride; }
    operator BasicImageView<const Float>() const { return { data, width, height, x_stride, y_stride }; }
};
using ImageView = BasicImageView<const float>;
using MutableImageView = BasicImageView<float>;

/// A half-open rectangle of pixels: x0 ≤ x < x1, y0 ≤ y < y1.
struct Roi {
    int x0, x1, y0, y1;
};

/// Side of the square images that `select` looks at.
constexpr int kThumbnailSize = 256;

/// A whole image squashed to kThumbnailSize × kThumbnailSize by exact area averaging, upright; interleaved RGB.
/// Display-encoded values for a photo, linear camera RGB for a RAW image.
struct Thumbnail {
    std::vector<float> rgb = std::vector<float>(std::size_t(kThumbnailSize) * kThumbnailSize * 3);

    ImageView view() const
    {
        return { rgb.data(), kThumbnailSize, kThumbnailSize, 3, std::ptrdiff_t(3) * kThumbnailSize };
    }
};

} // namespace srisp
