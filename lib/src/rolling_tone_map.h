// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tone_map.h"

namespace srisp {

/// The tone map in plain sums: any kernel size, no row computed twice within a tile.
class RollingToneMap : public ToneMap {
public:
    explicit RollingToneMap(const std::array<ConvolutionWeights, kToneLayers>& layers);

    int halo() const override { return radius() * kToneLayers; }
    int max_tile_width() const override { return kMaxTileWidth; }
    int good_tile_height() const override { return kTileHeight; }
    std::unique_ptr<ToneMapRunner> make_runner() const override;

    const PackedConvolution& layer(int index) const { return m_layers[index]; }
    int radius() const { return m_layers[0].taps == 9 ? 1 : 0; } ///< of one kernel

private:
    /// With the neighbours that the two 32→32 layers need (190, 192), the widths are nearly whole blocks of 3 vectors
    /// for 4, 8 and 16 lanes; three rows of three layers take 300 KB.
    static constexpr int kMaxTileWidth = 188;
    static constexpr int kTileHeight = 256; // the rows computed twice cost as much as 3 of its rows

    std::array<PackedConvolution, kToneLayers> m_layers;
};

} // namespace srisp
