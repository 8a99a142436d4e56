// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apply/tone_map.h"
#include "kernels/convolution.h"

namespace srisp {

/// How a layer is computed. What one layer writes, the next one reads: floats, or pairs of bf16 in half as many planes.
struct RollingLayer {
    PackedConvolution weights;
    void (*convolve_row)(const PackedConvolution& layer, const ConvolutionRow& row);
};

/// The tone map of 3×3 kernels in plain sums: no row computed twice within a tile.
class RollingToneMap : public ToneMap {
public:
    /// `max_tile_width`: the widest tile whose rows stay in L2.
    RollingToneMap(std::array<RollingLayer, kToneLayers> layers, int max_tile_width)
        : m_layers(std::move(layers)), m_max_tile_width(max_tile_width)
    {
    }

    int halo() const override { return kToneLayers; }
    int max_tile_width() const override { return m_max_tile_width; }
    int good_tile_height() const override { return kTileHeight; }
    std::unique_ptr<ToneMapRunner> make_runner() const override;

    const RollingLayer& layer(int index) const { return m_layers[index]; }

private:
    static constexpr int kTileHeight = 256; // the rows computed twice cost as much as 3 of its rows

    std::array<RollingLayer, kToneLayers> m_layers;
    int m_max_tile_width;
};

/// In float32.
RollingToneMap float_tone_map(const std::array<ConvolutionWeights, kToneLayers>& layers);
/// 3×3 kernels, the last three layers by bf16 dot products. Only where has_bf16().
RollingToneMap bf16_tone_map(const std::array<ConvolutionWeights, kToneLayers>& layers);

} // namespace srisp
