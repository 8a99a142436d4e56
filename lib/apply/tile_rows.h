// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <srisp/image.h>

#include "kernels/convolution.h"

// What the runners of the tone map share: a tile, and its rows between the layers and behind the last.

namespace srisp {

/// The last rows of what goes into one layer, for the columns of a tile and some beside it. Channels are planes of a
/// row.
class RowRing {
public:
    /// Floats between the planes of tiles of that width: with room for neighbours, the replicated edge and what kernels
    /// write past the end.
    static constexpr std::ptrdiff_t plane_stride(int max_tile_width)
    {
        return 2 * kSideRoom + max_tile_width + kRowSlack;
    }

    RowRing(int rows, int channels, int max_tile_width)
        : m_rows(rows), m_channels(channels), m_plane_stride(plane_stride(max_tile_width)),
          m_memory(m_plane_stride * channels * rows)
    {
    }

    std::ptrdiff_t plane_stride() const { return m_plane_stride; }

    /// Pixel of row y (any integer; those of the last rows are kept) that lies x columns right of the tile's first,
    /// channel 0.
    float* pixel(int x, int y)
    {
        const int slot = (y % m_rows + m_rows) % m_rows;
        return m_memory.data() + slot * m_plane_stride * m_channels + kSideRoom + x;
    }

    /// Repeats the outermost of the pixels [x0, x1) of a row beyond them, where they are the image's edge.
    void replicate_edges(int x0, int x1, int y, bool left, bool right)
    {
        float* row = pixel(x0, y);
        for (int channel = 0; channel < m_channels; ++channel, row += m_plane_stride) {
            if (left)
                row[-1] = row[0];
            if (right)
                row[x1 - x0] = row[x1 - x0 - 1];
        }
    }

private:
    static constexpr int kSideRoom = 8; // the halo of 4, the replicated edge, and some

    int m_rows, m_channels;
    std::ptrdiff_t m_plane_stride;
    std::vector<float> m_memory;
};

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

/// One row that leaves the tone map.
class ToneMapOutput {
public:
    explicit ToneMapOutput(int max_tile_width) : m_stride(RowRing::plane_stride(max_tile_width)), m_values(3 * m_stride)
    {
    }

    Planes planes() { return { m_values.data(), m_stride }; }

    /// Holding φ(v), becomes clamp01(v + φ(v)).
    void add_and_clamp(Planes v, int count)
    {
        for (int c = 0; c < 3; ++c)
            for (int x = 0; x < count; ++x) {
                float& out = planes().plane(c)[x];
                out = std::min(std::max(v.plane(c)[x] + out, 0.0f), 1.0f);
            }
    }

private:
    std::ptrdiff_t m_stride;
    std::vector<float> m_values;
};

} // namespace srisp
