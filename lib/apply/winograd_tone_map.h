// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apply/tone_map.h"
#include "kernels/winograd.h"

namespace srisp {

/// The tone map of 3×3 kernels whose two 32→32 layers, nine tenths of the work, are computed six rows at a time
/// with 2.25 times fewer multiply-adds. Groups of six rows lie at the same place of the image whatever the tile is, so
/// tiles and regions change no bits; whole groups are needed for that, hence the wider halo.
class WinogradToneMap : public ToneMap {
public:
    explicit WinogradToneMap(const std::array<ConvolutionWeights, kToneLayers>& layers);

    int halo() const override { return kHalo; }
    int max_tile_width() const override { return kMaxTileWidth; }
    int good_tile_height() const override { return kTileHeight; }
    std::unique_ptr<ToneMapRunner> make_runner() const override;

    const PackedConvolution& first() const { return m_first; }
    const PackedConvolution& last() const { return m_last; }
    const WinogradConvolution& middle(int index) const { return m_middle[index]; } ///< 0 or 1

private:
    static constexpr int kHalo = 17;
    /// Half of the plain tone map's: eight rows of three layers, not three, and the working memory of six rows have to
    /// stay in L2. With the neighbours that the layers need, nearly whole spans for 4, 8 and 16 lanes.
    static constexpr int kMaxTileWidth = 90;
    static constexpr int kTileHeight = 512; // the rows computed twice cost as much as 9 of its rows

    PackedConvolution m_first, m_last;
    std::array<WinogradConvolution, 2> m_middle;
};

} // namespace srisp
