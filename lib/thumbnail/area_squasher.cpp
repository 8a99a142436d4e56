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

/// The shares in order of the cells.
static std::vector<AxisCoverage::Share> by_cell(std::vector<AxisCoverage::Share> shares)
{
    std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
    return shares;
}

AreaSquasher::AreaSquasher(int width, int height, int size)
    : m_width(width), m_height(height), m_size(size), m_columns(by_cell(axis_coverage(width, size).shares)),
      m_rows(axis_coverage(height, size)), m_lines(std::size_t(size) * 3 * kRowsAtOnce), m_sums(std::size_t(size) * 3),
      m_rgb(std::size_t(size) * size * 3)
{
}

/// Adds up the shares of `Rows` rows of pixels, one below the other, for each cell of as many lines. Each cell's sum
/// stays in registers, and those of several rows do not wait for each other.
template<int Rows> static void squash_rows(const std::vector<AxisCoverage::Share>& columns, const float* pixel,
                                           std::ptrdiff_t x_stride, std::ptrdiff_t y_stride, double* lines,
                                           std::size_t line)
{
    for (auto share = columns.begin(); share != columns.end();) {
        double sums[Rows][3] = {};
        const int cell = share->cell;
        for (; share != columns.end() && share->cell == cell; ++share)
            for (int row = 0; row < Rows; ++row) {
                const float* v = pixel + share->input * x_stride + row * y_stride;
                for (int c = 0; c < 3; ++c)
                    sums[row][c] += share->length * v[c];
            }
        for (int row = 0; row < Rows; ++row)
            std::copy_n(sums[row], 3, lines + row * line + std::size_t(cell) * 3);
    }
}

void AreaSquasher::add_line(const double* line)
{
    for (int i = m_rows.first_share[m_next_row]; i < m_rows.first_share[m_next_row + 1]; ++i) {
        const AxisCoverage::Share& share = m_rows.shares[i];
        if (share.cell != m_row_of_cells)
            finish_cells();
        for (std::size_t k = 0; k < m_sums.size(); ++k)
            m_sums[k] += share.length * line[k];
    }
    if (++m_next_row == m_height)
        finish_cells();
}

void AreaSquasher::finish_cells()
{
    const double cell_area = (m_width / double(m_size)) * (m_height / double(m_size));
    std::transform(m_sums.begin(), m_sums.end(), m_rgb.begin() + std::ptrdiff_t(m_sums.size()) * m_row_of_cells,
                   [&](double sum) { return static_cast<float>(sum / cell_area); });
    std::fill(m_sums.begin(), m_sums.end(), 0.0);
    ++m_row_of_cells;
}

void AreaSquasher::add_rows(ImageView rows)
{
    const std::size_t line = std::size_t(m_size) * 3;
    const int count = std::min(rows.height, m_height - m_next_row);
    for (int y = 0; y < count;) {
        const bool several = count - y >= kRowsAtOnce;
        const auto squash = several ? squash_rows<kRowsAtOnce> : squash_rows<1>;
        squash(m_columns, rows.pixel(0, y), rows.x_stride, rows.y_stride, m_lines.data(), line);
        const int done = several ? kRowsAtOnce : 1;
        for (int row = 0; row < done; ++row)
            add_line(m_lines.data() + std::size_t(row) * line);
        y += done;
    }
}

std::vector<float> AreaSquasher::finish(int orientation) const
{
    return oriented_square(m_rgb, m_size, orientation);
}

std::vector<float> oriented_square(std::vector<float> rgb, int size, int orientation)
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
