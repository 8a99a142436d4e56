// SPDX-License-Identifier: Apache-2.0
#include "reference/mosaic_thumbnail.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <srisp/thumbnail.h>

#include "base/parallel.h"
#include "thumbnail/area_squasher.h"

namespace srisp {

namespace {

using Shares = std::vector<AxisCoverage::Share>;

/// The inputs of each cell, instead of the cells of each input.
std::vector<Shares> shares_by_cell(int count)
{
    std::vector<Shares> cells(kThumbnailSize);
    for (const auto& share : axis_coverage(count, kThumbnailSize).shares)
        cells[std::size_t(share.cell)].push_back(share);
    return cells;
}

/// The sensor's columns as the thumbnail's cells see them, for each row of the filter pattern.
struct MosaicColumns {
    struct Color {
        Shares columns;
        double length = 0; ///< of them all
    };
    std::vector<std::array<Color, 3>> cells; ///< [row][cell]

    explicit MosaicColumns(const RawPixels& pixels)
    {
        const std::vector<Shares> shares = shares_by_cell(pixels.width);
        for (int row = 0; row < pixels.cfa.rows; ++row)
            for (const Shares& cell : shares) {
                cells.emplace_back();
                for (const auto& column : cell) {
                    Color& color = cells.back()[std::size_t(pixels.cfa.color(row, column.input))];
                    color.columns.push_back(column);
                    color.length += column.length;
                }
            }
    }
};

/// One row of the thumbnail of a mosaic. `rows`: the sensor rows that it covers.
void average_mosaic_row(const RawPixels& pixels, const RowScaler& scaler, const Shares& rows,
                        const MosaicColumns& columns, float* target)
{
    const CfaPattern& cfa = pixels.cfa;
    const std::size_t width = std::size_t(pixels.width);
    std::vector<float> line(width);
    // Sums down the columns, apart for each row of the pattern, so that a place in it has one colour. Floats: a cell
    // has some dozen rows, and its columns are added up in double.
    std::vector<float> sums(width * std::size_t(cfa.rows));
    std::vector<double> lengths(std::size_t(cfa.rows));
    for (const auto& row : rows) {
        scaler.scale(row.input, line.data());
        float* sum = sums.data() + width * std::size_t(row.input % cfa.rows);
        const float length = float(row.length);
        for (std::size_t x = 0; x < width; ++x)
            sum[x] += length * line[x];
        lengths[std::size_t(row.input % cfa.rows)] += row.length;
    }
    for (std::size_t cell = 0; cell < kThumbnailSize; ++cell)
        for (std::size_t c = 0; c < 3; ++c) {
            double total = 0, area = 0;
            for (std::size_t row = 0; row < lengths.size(); ++row) {
                const MosaicColumns::Color& color = columns.cells[row * kThumbnailSize + cell][c];
                for (const auto& column : color.columns)
                    total += column.length * double(sums[width * row + std::size_t(column.input)]);
                area += lengths[row] * color.length;
            }
            target[cell * 3 + c] = float(total / area);
        }
}

Thumbnail average_mosaic(const RawPixels& pixels)
{
    const RowScaler scaler(pixels);
    const std::vector<Shares> rows = shares_by_cell(pixels.height);
    const MosaicColumns columns(pixels);
    Thumbnail thumbnail;
    parallel_tasks(kThumbnailSize, 0, [&](std::int64_t y) {
        average_mosaic_row(pixels, scaler, rows[std::size_t(y)], columns,
                           thumbnail.rgb.data() + std::size_t(y) * kThumbnailSize * 3);
    });
    return thumbnail;
}

/// Bilinear demosaic of one row of a Bayer mosaic. `lines`: the rows above, here and below; null outside the sensor. At
/// the border the missing neighbours are left out of the means.
void demosaic_row(const RawPixels& pixels, int y, const std::array<const float*, 3>& lines, float* target)
{
    for (int x = 0; x < pixels.width; ++x) {
        std::array<float, 3> sum{}, weight{};
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const float* line = lines[std::size_t(dy + 1)];
                if (!line || x + dx < 0 || x + dx >= pixels.width)
                    continue;
                const std::size_t color =
                    std::size_t(pixels.cfa.color(y + dy + pixels.cfa.rows, x + dx + pixels.cfa.columns));
                const float w = float((2 - std::abs(dx)) * (2 - std::abs(dy)));
                sum[color] += w * line[x + dx];
                weight[color] += w;
            }
        const std::size_t own = std::size_t(pixels.cfa.color(y, x));
        for (std::size_t c = 0; c < 3; ++c)
            target[std::size_t(x) * 3 + c] = c == own ? lines[1][x] : sum[c] / weight[c];
    }
}

Thumbnail average_demosaiced(const RawPixels& pixels)
{
    const RowScaler scaler(pixels);
    const std::size_t width = std::size_t(pixels.width);
    std::array<std::vector<float>, 3> ring; // scaled row y lies in ring[y % 3]
    for (int y = 0; y < 2; ++y) {
        ring[std::size_t(y)].resize(width);
        scaler.scale(y, ring[std::size_t(y)].data());
    }
    ring[2].resize(width);
    std::vector<float> rgb(width * 3);
    ThumbnailBuilder builder(pixels.width, pixels.height);
    for (int y = 0; y < pixels.height; ++y) {
        if (y > 0 && y + 1 < pixels.height)
            scaler.scale(y + 1, ring[std::size_t(y + 1) % 3].data());
        demosaic_row(pixels, y,
                     { y > 0 ? ring[std::size_t(y - 1) % 3].data() : nullptr, ring[std::size_t(y) % 3].data(),
                       y + 1 < pixels.height ? ring[std::size_t(y + 1) % 3].data() : nullptr },
                     rgb.data());
        builder.add_rows({ rgb.data(), pixels.width, 1, 3, std::ptrdiff_t(width) * 3 });
    }
    return builder.finish(1);
}

Thumbnail average_rgb(const RawPixels& pixels)
{
    const RowScaler scaler(pixels);
    std::vector<float> rgb(std::size_t(pixels.width) * 3);
    ThumbnailBuilder builder(pixels.width, pixels.height);
    for (int y = 0; y < pixels.height; ++y) {
        scaler.scale(y, rgb.data());
        builder.add_rows({ rgb.data(), pixels.width, 1, 3, std::ptrdiff_t(pixels.width) * 3 });
    }
    return builder.finish(1);
}

} // namespace

Thumbnail raw_thumbnail(const RawPixels& pixels)
{
    if (pixels.channels == 3)
        return average_rgb(pixels);
    const bool small = std::min(pixels.width, pixels.height) < 2 * kThumbnailSize;
    return small ? average_demosaiced(pixels) : average_mosaic(pixels);
}

} // namespace srisp
