// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <srisp/image.h>

#include "thumbnail/area_squasher.h"

namespace srisp::tool {

/// An image in memory: R, G, B of each pixel, rows from top to bottom.
struct Pixels {
    int width = 0, height = 0;
    std::vector<float> rgb;

    Pixels() = default;
    Pixels(int columns, int rows) : width(columns), height(rows), rgb(std::size_t(columns) * std::size_t(rows) * 3) {}

    ImageView view() const { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
    MutableImageView mutable_view() { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
    /// A copy of a part.
    Pixels part(Roi roi) const;
    /// Means of R, G, B.
    std::array<double, 3> means() const;
};

/// The size of an image whose longer side is to be `longest` at most; 0: as it is.
std::array<int, 2> reduced_size(int width, int height, int longest);

/// Makes an image another size by exact area averaging, row by row; enlarging, too.
class AreaReducer {
public:
    AreaReducer(int width, int height, int columns, int rows);

    /// The next rows of `channels` values a pixel, of which the first three are taken; of a single one, that for all.
    void add_rows(const float* rows, int count, int channels);
    /// Once all rows were added.
    Pixels take() { return std::move(m_result); }

private:
    void finish_cells();

    int m_width, m_row = 0, m_cell = 0; ///< the next row; the row of cells that it lies in
    AxisCoverage m_columns, m_rows;
    std::vector<double> m_line, m_sums;
    Pixels m_result;
    double m_scale;
};

/// Another size by area averaging.
Pixels resized(const Pixels& pixels, int width, int height);

/// Turned upright: what an EXIF orientation (1 … 8; others are taken as 1) asks for.
Pixels oriented(Pixels pixels, int orientation);

} // namespace srisp::tool
