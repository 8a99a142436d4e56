// SPDX-License-Identifier: Apache-2.0
#include "apply/tiled_pipeline.h"

#include <algorithm>

#include "base/parallel.h"
#include "kernels/pointwise.h"

namespace srisp {

namespace {

constexpr int kMinTileRows = 16;

/// The region cut into tiles: as few columns as the tone map's memory allows, all about equally wide.
class TileGrid {
public:
    TileGrid(Roi roi, const ToneMap& tone_map, int threads) : m_roi(roi)
    {
        const int width = roi.x1 - roi.x0, height = roi.y1 - roi.y0;
        m_columns = (width + tone_map.max_tile_width() - 1) / tone_map.max_tile_width();
        m_tile_width = (width + m_columns - 1) / m_columns;
        // Enough tiles to keep all threads busy to the end.
        const int rows_wanted = (4 * threads + m_columns - 1) / m_columns;
        m_tile_height = std::clamp((height + rows_wanted - 1) / rows_wanted, kMinTileRows, tone_map.good_tile_height());
        m_rows = (height + m_tile_height - 1) / m_tile_height;
    }

    int count() const { return m_rows * m_columns; }
    Roi tile(int index) const
    {
        const int x0 = m_roi.x0 + index % m_columns * m_tile_width, y0 = m_roi.y0 + index / m_columns * m_tile_height;
        return { x0, std::min(x0 + m_tile_width, m_roi.x1), y0, std::min(y0 + m_tile_height, m_roi.y1) };
    }

private:
    Roi m_roi;
    int m_columns, m_rows, m_tile_width, m_tile_height;
};

void gather(const float* pixel, std::ptrdiff_t x_stride, int count, Planes row)
{
    if (x_stride == 3)
        return split_channels(pixel, row, count);
    for (int x = 0; x < count; ++x, pixel += x_stride)
        for (int c = 0; c < 3; ++c)
            row.plane(c)[x] = pixel[c];
}

void scatter(Planes row, int count, float* pixel, std::ptrdiff_t x_stride)
{
    if (x_stride == 3)
        return join_channels(row, pixel, count);
    for (int x = 0; x < count; ++x, pixel += x_stride)
        for (int c = 0; c < 3; ++c)
            pixel[c] = row.plane(c)[x];
}

} // namespace

void TiledPipeline::run_tile(ToneMapRunner& runner, const Job& job, Roi tile) const
{
    const auto load = [&](int y, int x0, int x1, Planes row) {
        const ImagePart& source = job.source;
        gather(source.pixels.pixel(x0 - source.x, y - source.y), source.pixels.x_stride, x1 - x0, row);
        if (m_direction == Direction::forward)
            before_tone_map(m_blocks, row, row, x1 - x0);
        else // what is no number must not reach its neighbours
            clamp01(row, row, std::size_t(x1 - x0));
    };
    const auto store = [&](int y, Planes row) {
        if (m_direction == Direction::reverse)
            after_tone_map(m_blocks, row, row, tile.x1 - tile.x0);
        scatter(row, tile.x1 - tile.x0, job.target.pixel(tile.x0 - job.roi.x0, y - job.roi.y0), job.target.x_stride);
    };
    runner.run(tile, job.source.full_width, job.source.full_height, load, store);
}

/// Each worker takes the next tile until none is left, so a slow core holds nobody up.
void TiledPipeline::run(const Job& job, int threads, Progress& progress) const
{
    const TileGrid grid(job.roi, *m_tone_map, threads);
    std::atomic<int> next{ 0 };
    const auto work = [&](std::int64_t) {
        const std::unique_ptr<ToneMapRunner> runner = m_tone_map->make_runner();
        for (int i = next++; i < grid.count() && !progress.cancelled(); i = next++) {
            const Roi tile = grid.tile(i);
            run_tile(*runner, job, tile);
            progress.add(std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0));
        }
    };
    const int workers = std::min(threads, grid.count());
    parallel_tasks(workers, workers, work);
}

} // namespace srisp
