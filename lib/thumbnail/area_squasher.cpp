// SPDX-License-Identifier: Apache-2.0
#include "thumbnail/area_squasher.h"

#include <algorithm>
#include <cstdint>

namespace srisp {

AxisCoverage axis_coverage(int count, int cells)
{
    // On a grid of count × cells steps, input i spans [i·cells, (i+1)·cells) and cell j spans [j·count, (j+1)·count).
    AxisCoverage coverage;
    coverage.first_share.reserve(count + 1);
    for (std::int64_t input = 0; input < count; ++input) {
        coverage.first_share.push_back(static_cast<int>(coverage.shares.size()));
        const std::int64_t begin = input * cells, end = begin + cells;
        for (std::int64_t cell = begin / count; cell * count < end; ++cell) {
            const std::int64_t shared = std::min(end, (cell + 1) * count) - std::max(begin, cell * count);
            coverage.shares.push_back(
                { static_cast<int>(input), static_cast<int>(cell), static_cast<double>(shared) / cells });
        }
    }
    coverage.first_share.push_back(static_cast<int>(coverage.shares.size()));
    return coverage;
}

AreaSquasher::AreaSquasher(int width, int height, int size)
    : m_width(width), m_height(height), m_size(size), m_columns(axis_coverage(width, size)),
      m_rows(axis_coverage(height, size)), m_line(std::size_t(size) * 3), m_sums(std::size_t(size) * size * 3)
{
}

/// Adds the shares of one row of pixels to the cells of `line`.
static void squash_row(const AxisCoverage& columns, const float* pixel, std::ptrdiff_t x_stride,
                       std::vector<double>& line)
{
    std::fill(line.begin(), line.end(), 0.0);
    for (const AxisCoverage::Share& share : columns.shares) {
        const float* v = pixel + share.input * x_stride;
        double* cell = line.data() + share.cell * 3;
        for (int c = 0; c < 3; ++c)
            cell[c] += share.length * v[c];
    }
}

void AreaSquasher::add_rows(ImageView rows)
{
    for (int y = 0; y < rows.height && m_next_row < m_height; ++y, ++m_next_row) {
        squash_row(m_columns, rows.pixel(0, y), rows.x_stride, m_line);
        for (int i = m_rows.first_share[m_next_row]; i < m_rows.first_share[m_next_row + 1]; ++i) {
            const AxisCoverage::Share& share = m_rows.shares[i];
            double* sums = m_sums.data() + share.cell * m_line.size();
            for (std::size_t k = 0; k < m_line.size(); ++k)
                sums[k] += share.length * m_line[k];
        }
    }
}

std::vector<float> AreaSquasher::finish(int orientation) const
{
    const double cell_area = (m_width / double(m_size)) * (m_height / double(m_size));
    std::vector<float> rgb(m_sums.size());
    std::transform(m_sums.begin(), m_sums.end(), rgb.begin(),
                   [&](double sum) { return static_cast<float>(sum / cell_area); });
    return oriented_square(rgb, m_size, orientation);
}

std::vector<float> oriented_square(const std::vector<float>& rgb, int size, int orientation)
{
    if (orientation < 2 || orientation > 8)
        return rgb;
    // EXIF: 2, 3, 4 mirror or turn by 180°; 5 … 8 swap the axes. (u, v): where the upright pixel (x, y) is stored.
    const bool swap = orientation >= 5;
    const bool flip_u = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool flip_v = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    std::vector<float> upright(rgb.size());
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const int along = swap ? y : x, across = swap ? x : y;
            const int u = flip_u ? size - 1 - along : along, v = flip_v ? size - 1 - across : across;
            std::copy_n(rgb.data() + (std::ptrdiff_t(v) * size + u) * 3, 3,
                        upright.data() + (std::ptrdiff_t(y) * size + x) * 3);
        }
    return upright;
}

} // namespace srisp
