// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <srisp/image.h>

#include "thumbnail/area_average.h"

namespace srisp {

/// Squashes an image to size × size by exact area averaging, as ThumbnailBuilder does to 256 × 256. One per thread.
class AreaSquasher {
public:
    /// `width`, `height`: of the whole image in pixels, at least 1 × 1.
    AreaSquasher(int width, int height, int size);

    /// Adds the next `rows.height` rows, from top to bottom; `rows.width` is the width of the image.
    void add_rows(ImageView rows);
    /// Interleaved RGB once all rows were added, turned upright: `orientation` as in EXIF (1 … 8) of the rows.
    std::vector<float> finish(int orientation) const;

private:
    int m_width, m_height, m_size, m_next_row = 0;
    AxisCoverage m_columns, m_rows;
    std::vector<double> m_line; ///< one input row, squashed
    std::vector<double> m_sums; ///< of shares, over the whole image
};

/// Turns a size × size image (interleaved RGB) upright: what an EXIF `orientation` (others than 1 … 8 are taken as 1)
/// asks for.
std::vector<float> oriented_square(const std::vector<float>& rgb, int size, int orientation);

} // namespace srisp
