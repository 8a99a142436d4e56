// SPDX-License-Identifier: Apache-2.0
#include "pixels.h"

#include <algorithm>
#include <cmath>

#include "thumbnail/area_squasher.h"

namespace srisp::tool {

Pixels Pixels::part(Roi roi) const
{
    Pixels result(roi.x1 - roi.x0, roi.y1 - roi.y0);
    for (int y = 0; y < result.height; ++y)
        std::copy_n(view().pixel(roi.x0, roi.y0 + y), std::size_t(result.width) * 3,
                    &result.rgb[std::size_t(y) * 3 * result.width]);
    return result;
}

std::array<double, 3> Pixels::means() const
{
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < rgb.size(); ++i)
        sums[i % 3] += rgb[i];
    for (double& sum : sums)
        sum /= double(width) * height;
    return sums;
}

std::array<int, 2> reduced_size(int width, int height, int longest)
{
    const int longer = std::max(width, height);
    if (longest <= 0 || longer <= longest)
        return { width, height };
    const double scale = double(longest) / longer;
    return { std::max(1, int(std::lround(width * scale))), std::max(1, int(std::lround(height * scale))) };
}

AreaReducer::AreaReducer(int width, int height, int columns, int rows)
    : m_width(width), m_columns(axis_coverage(width, columns)), m_rows(axis_coverage(height, rows)),
      m_line(std::size_t(columns) * 3), m_sums(std::size_t(columns) * 3), m_result(columns, rows),
      m_scale(double(columns) / width * rows / height)
{
}

void AreaReducer::add_rows(const float* rows, int count, int channels)
{
    const int second = channels > 2 ? 1 : 0, third = channels > 2 ? 2 : 0;
    for (int i = 0; i < count; ++i, ++m_row, rows += std::size_t(m_width) * std::size_t(channels)) {
        std::fill(m_line.begin(), m_line.end(), 0.0);
        for (const auto& share : m_columns.shares) {
            const float* p = rows + std::size_t(share.input) * std::size_t(channels);
            double* cell = &m_line[std::size_t(share.cell) * 3];
            cell[0] += share.length * p[0];
            cell[1] += share.length * p[second];
            cell[2] += share.length * p[third];
        }
        for (int s = m_rows.first_share[m_row]; s < m_rows.first_share[m_row + 1]; ++s) {
            const auto& share = m_rows.shares[s];
            if (share.cell != m_cell) {
                finish_cells();
                m_cell = share.cell;
            }
            for (std::size_t k = 0; k < m_sums.size(); ++k)
                m_sums[k] += share.length * m_line[k];
        }
    }
    if (m_row + 1 == int(m_rows.first_share.size()))
        finish_cells();
}

void AreaReducer::finish_cells()
{
    float* out = &m_result.rgb[std::size_t(m_cell) * m_sums.size()];
    for (std::size_t k = 0; k < m_sums.size(); ++k)
        out[k] = float(m_sums[k] * m_scale);
    std::fill(m_sums.begin(), m_sums.end(), 0.0);
}

Pixels resized(const Pixels& pixels, int width, int height)
{
    AreaReducer reducer(pixels.width, pixels.height, width, height);
    reducer.add_rows(pixels.rgb.data(), pixels.height, 3);
    return reducer.take();
}

Pixels oriented(Pixels pixels, int orientation)
{
    if (orientation < 2 || orientation > 8)
        return pixels;
    const bool turned = orientation > 4;
    const int right = pixels.width - 1, bottom = pixels.height - 1;
    Pixels result(turned ? pixels.height : pixels.width, turned ? pixels.width : pixels.height);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            // Where the pixel lies in what is stored. [EXIF 2.3, tag Orientation]
            const int u = turned ? y : x, v = turned ? x : y;
            const bool mirrored_x = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
            const bool mirrored_y = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
            std::copy_n(pixels.view().pixel(mirrored_x ? right - u : u, mirrored_y ? bottom - v : v), 3,
                        result.mutable_view().pixel(x, y));
        }
    return result;
}

} // namespace srisp::tool
