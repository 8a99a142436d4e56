// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/convolution.h"

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

} // namespace srisp
