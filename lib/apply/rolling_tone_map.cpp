// SPDX-License-Identifier: Apache-2.0
#include "apply/rolling_tone_map.h"

#include "apply/tile_rows.h"
#include "kernels/bf16_convolution.h"

namespace srisp {

namespace {

class RollingRunner : public ToneMapRunner {
public:
    explicit RollingRunner(const RollingToneMap& tone_map) : m_tone_map(tone_map), m_out(tone_map.max_tile_width())
    {
        for (int l = 0; l < kToneLayers; ++l)
            // A kernel needs three rows; v itself is needed again when φ is known, and the input is then a halo ahead.
            m_inputs.push_back(
                { RowRing(l == 0 ? kToneLayers + 1 : 3, tone_map.layer(l).weights.inputs, tone_map.max_tile_width()),
                  0 });
    }

    void run(Roi roi, int width, int height, LoadRow load, StoreRow store) override
    {
        const ImageTile tile{ roi, width, height };
        for (int l = 0; l < kToneLayers; ++l)
            m_inputs[l].next_row = std::max(roi.y0 - (kToneLayers - l), 0);
        for (int y = roi.y0; y < roi.y1; ++y) {
            compute_rows_up_to(kToneLayers - 1, tile.clamp_row(y + 1), tile, load);
            convolve(kToneLayers - 1, y, 0, tile.width_px(), m_out.planes().data, m_out.planes().stride, tile);
            m_out.add_and_clamp({ m_inputs[0].rows.pixel(0, y), m_inputs[0].rows.plane_stride() }, tile.width_px());
            store(y, m_out.planes());
        }
    }

private:
    /// What goes into one layer.
    struct Input {
        RowRing rows;
        int next_row; ///< the first that was not computed yet
    };

    /// Output pixels [x0, x1) of row y of a layer.
    void convolve(int layer, int y, int x0, int x1, float* out, std::ptrdiff_t out_plane_stride, const ImageTile& tile)
    {
        RowRing& input = m_inputs[layer].rows;
        ConvolutionRow row{};
        for (int dy = -1, t = 0; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx, ++t)
                row.taps[t] = input.pixel(x0 + dx, tile.clamp_row(y + dy));
        row.in_plane_stride = input.plane_stride();
        row.out = out;
        row.out_plane_stride = out_plane_stride;
        row.width = x1 - x0;
        row.relu = layer < kToneLayers - 1;
        const RollingLayer& kernel = m_tone_map.layer(layer);
        kernel.convolve_row(kernel.weights, row);
    }

    /// The next row of what goes into `layer`: from the image (layer 0) or from the layer before.
    void compute_row(int layer, const ImageTile& tile, LoadRow load)
    {
        Input& input = m_inputs[layer];
        const int y = input.next_row++;
        const int beside = kToneLayers - layer;
        const int x0 = tile.first_column(beside), x1 = tile.end_column(beside);
        float* const row = input.rows.pixel(x0, y);
        if (layer == 0)
            load(y, tile.roi.x0 + x0, tile.roi.x0 + x1, { row, input.rows.plane_stride() });
        else
            convolve(layer - 1, y, x0, x1, row, input.rows.plane_stride(), tile);
        tile.replicate_edges(input.rows, y, beside);
    }

    void compute_rows_up_to(int layer, int y, const ImageTile& tile, LoadRow load)
    {
        for (Input& input = m_inputs[layer]; input.next_row <= y;) {
            if (layer > 0)
                compute_rows_up_to(layer - 1, tile.clamp_row(input.next_row + 1), tile, load);
            compute_row(layer, tile, load);
        }
    }

    const RollingToneMap& m_tone_map;
    std::vector<Input> m_inputs;
    ToneMapOutput m_out;
};

} // namespace

// With the neighbours that the two 32→32 layers need (190, 192; 382, 384), the widths are nearly whole blocks of 3
// vectors for 4, 8 and 16 lanes; three rows of three layers take 300 KB, in bf16 half as much for a pixel.
constexpr int kFloatTileWidth = 188, kBf16TileWidth = 380;

RollingToneMap float_tone_map(const std::array<ConvolutionWeights, kToneLayers>& layers)
{
    std::array<RollingLayer, kToneLayers> packed;
    for (int l = 0; l < kToneLayers; ++l)
        packed[l] = { pack_convolution(layers[l]), convolve_row };
    return { std::move(packed), kFloatTileWidth };
}

RollingToneMap bf16_tone_map(const std::array<ConvolutionWeights, kToneLayers>& layers)
{
    return { { RollingLayer{ pack_convolution(layers[0]), convolve_floats_to_pairs },
               { pack_bf16(layers[1]), convolve_pairs_to_pairs },
               { pack_bf16(layers[2]), convolve_pairs_to_pairs },
               { pack_bf16(layers[3]), convolve_pairs_to_floats } },
             kBf16TileWidth };
}

std::unique_ptr<ToneMapRunner> RollingToneMap::make_runner() const
{
    return std::make_unique<RollingRunner>(*this);
}

} // namespace srisp
