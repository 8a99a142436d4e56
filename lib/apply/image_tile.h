// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include <srisp/image.h>

#include "apply/row_ring.h"

namespace srisp {

/// A tile of an image, as the runners of the tone map see it.
struct ImageTile {
    Roi roi;
    int width, height; ///< of the image

    int width_px() const { return roi.x1 - roi.x0; }
    int clamp_row(int y) const { return std::clamp(y, 0, height - 1); }
    /// Columns of the tile and `beside` ones on each side, as far as the image goes; relative to the tile's first.
    int first_column(int beside) const { return std::max(roi.x0 - beside, 0) - roi.x0; }
    int end_column(int beside) const { return std::min(roi.x1 + beside, width) - roi.x0; }

    /// Repeats the image's edge in a row of which these columns were computed.
    void replicate_edges(RowRing& ring, int y, int beside) const
    {
        const int x0 = first_column(beside), x1 = end_column(beside);
        ring.replicate_edges(x0, x1, y, roi.x0 + x0 == 0, roi.x0 + x1 == width);
    }
};

} // namespace srisp
