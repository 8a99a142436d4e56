// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <srisp/image.h>

namespace srisp {

/// How `count` inputs of width 1 lie on `cells` equal cells along one axis: input i touches cells first[i] …
/// first[i + 1 … ] with the lengths that they share. One table serves rows and columns.
struct AxisCoverage {
    struct Share {
        int input, cell;
        double length; ///< of the input that lies in the cell, in inputs; the shares of a cell sum to count / cells
    };
    std::vector<Share> shares;    ///< ordered by input, then by cell
    std::vector<int> first_share; ///< index of the first share of input i; count + 1 entries
};

/// Exact for any count ≥ 1, enlarging included. Computed in integers, so that shares of a cell sum exactly.
AxisCoverage axis_coverage(int count, int cells);

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
    static constexpr int kRowsAtOnce = 4;
    void add_line(const double* line);
    void finish_cells();

    int m_width, m_height, m_size, m_next_row = 0, m_row_of_cells = 0;
    std::vector<AxisCoverage::Share> m_columns; ///< in order of the cells
    AxisCoverage m_rows;
    std::vector<double> m_lines; ///< some input rows, squashed
    std::vector<double> m_sums;  ///< of shares, in the row of cells that the next row of pixels lies in
    std::vector<float> m_rgb;    ///< the cells above it
};

/// Turns a size × size image (interleaved RGB) upright: what an EXIF `orientation` (others than 1 … 8 are taken as 1)
/// asks for.
std::vector<float> oriented_square(std::vector<float> rgb, int size, int orientation);

} // namespace srisp
