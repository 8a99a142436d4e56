// SPDX-License-Identifier: Apache-2.0
#include "apply/winograd_tone_map.h"

#include "apply/tile_rows.h"

namespace srisp {

namespace {

constexpr int kGroup = kWinogradOutputs;

/// The group of six output rows, [6 g − 3, 6 g + 3), that row y is in.
int group_of(int y)
{
    return (y + 3 + kGroup * 1000000) / kGroup - 1000000;
}

// In step s, each layer computes six rows, one row above those of the layer before, so that their lower neighbours are
// there:
//   first    [6 s,     6 s + 6)
//   middle 0 [6 s − 1, 6 s + 5)
//   middle 1 [6 s − 2, 6 s + 4)
//   last     [6 s − 3, 6 s + 3)
// A group of the middle layers takes the rounding errors of all eight rows it reads; for the same bits in all tiles it
// reads whole groups. So the last layer in steps from S on needs middle 1 from S − 1 on, middle 0 from S − 2 on, the
// first layer's rows from 6 S − 14 on, and the image's from 6 S − 15 on: 17 above the tile's first at most.
class WinogradRunner : public ToneMapRunner {
public:
    explicit WinogradRunner(const WinogradToneMap& tone_map)
        : m_tone_map(tone_map), m_out(tone_map.max_tile_width()),
          m_scratch(winograd_scratch_size(tone_map.first().outputs))
    {
        const int features = tone_map.first().outputs, width = tone_map.max_tile_width();
        m_rings.emplace_back(kImageRows, tone_map.first().inputs, width);
        for (int l = 1; l < kToneLayers; ++l)
            m_rings.emplace_back(kWinogradInputs, features, width);
    }

    void run(Roi roi, int width, int height, LoadRow load, StoreRow store) override
    {
        const ImageTile tile{ roi, width, height };
        const int first_group = group_of(roi.y0), last_group = group_of(roi.y1 - 1);
        const int first_row = std::max(kGroup * first_group - 14, 0);
        m_next_image_row = std::max(first_row - 1, 0);
        for (int s = first_group - 3; s <= last_group; ++s) {
            for (int y = std::max(kGroup * s, first_row); y < std::min(kGroup * (s + 1), height); ++y)
                compute_first(y, tile, load);
            if (s >= first_group - 2)
                compute_middle(0, kGroup * s - 1, tile);
            if (s >= first_group - 1)
                compute_middle(1, kGroup * s - 2, tile);
            for (int y = std::max(kGroup * s - 3, roi.y0); y < std::min(kGroup * s + 3, roi.y1); ++y)
                compute_last(y, tile, store);
        }
    }

private:
    static constexpr int kImageRows = 16; // v is needed again ten rows behind the last that was loaded

    /// One row by plain sums; `ring`: of its input.
    void convolve(const PackedConvolution& layer, int ring, int y, int x0, int x1, float* out,
                  std::ptrdiff_t out_plane_stride, bool relu, const ImageTile& tile)
    {
        ConvolutionRow row{ {}, m_rings[ring].plane_stride(), out, out_plane_stride, x1 - x0, relu };
        for (int t = 0; t < 9; ++t)
            row.taps[t] = m_rings[ring].pixel(x0 + t % 3 - 1, tile.clamp_row(y + t / 3 - 1));
        convolve_row(layer, row);
    }

    void compute_first(int y, const ImageTile& tile, LoadRow load)
    {
        for (; m_next_image_row <= tile.clamp_row(y + 1); ++m_next_image_row) {
            const int x0 = tile.first_column(4), x1 = tile.end_column(4);
            load(m_next_image_row, tile.roi.x0 + x0, tile.roi.x0 + x1,
                 { m_rings[0].pixel(x0, m_next_image_row), m_rings[0].plane_stride() });
            tile.replicate_edges(m_rings[0], m_next_image_row, 4);
        }
        const int x0 = tile.first_column(3), x1 = tile.end_column(3);
        convolve(m_tone_map.first(), 0, y, x0, x1, m_rings[1].pixel(x0, y), m_rings[1].plane_stride(), true, tile);
        tile.replicate_edges(m_rings[1], y, 3);
    }

    /// Six rows from y on; those outside the image come out too, and are not used.
    void compute_middle(int index, int y, const ImageTile& tile)
    {
        if (y + kGroup <= 0 || y >= tile.height)
            return;
        RowRing &from = m_rings[index + 1], &to = m_rings[index + 2];
        const int beside = 2 - index, x0 = tile.first_column(beside), x1 = tile.end_column(beside);
        WinogradRows rows{ {}, from.plane_stride(), {}, to.plane_stride(), x1 - x0, true };
        for (int k = 0; k < kWinogradInputs; ++k)
            rows.in[k] = from.pixel(x0 - 1, tile.clamp_row(y - 1 + k));
        for (int k = 0; k < kGroup; ++k)
            rows.out[k] = to.pixel(x0, y + k);
        convolve_six_rows(m_tone_map.middle(index), rows, m_scratch.data());
        for (int k = 0; k < kGroup; ++k)
            tile.replicate_edges(to, y + k, beside);
    }

    void compute_last(int y, const ImageTile& tile, StoreRow store)
    {
        convolve(m_tone_map.last(), kToneLayers - 1, y, 0, tile.width_px(), m_out.planes().data, m_out.planes().stride,
                 false, tile);
        m_out.add_and_clamp({ m_rings[0].pixel(0, y), m_rings[0].plane_stride() }, tile.width_px());
        store(y, m_out.planes());
    }

    const WinogradToneMap& m_tone_map;
    std::vector<RowRing> m_rings; ///< of what goes into each layer
    ToneMapOutput m_out;
    std::vector<float> m_scratch;
    int m_next_image_row = 0;
};

} // namespace

WinogradToneMap::WinogradToneMap(const std::array<ConvolutionWeights, kToneLayers>& layers)
    : m_first(pack_convolution(layers[0])),
      m_last(pack_convolution(layers[3])), m_middle{ pack_winograd(layers[1]), pack_winograd(layers[2]) }
{
}

std::unique_ptr<ToneMapRunner> WinogradToneMap::make_runner() const
{
    return std::make_unique<WinogradRunner>(*this);
}

} // namespace srisp
