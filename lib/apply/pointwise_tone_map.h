// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apply/tone_map.h"
#include "kernels/pixel_tone_map.h"

namespace srisp {

/// The tone map of 1×1 kernels, for those who look at what leaves it: rows are independent.
class PointwiseToneMap : public ToneMap {
public:
    explicit PointwiseToneMap(const std::array<ConvolutionWeights, kToneLayers>& layers)
        : m_layers(pack_pixel_tone_map(layers))
    {
    }

    int halo() const override { return 0; }
    int max_tile_width() const override { return kMaxTileWidth; }
    int good_tile_height() const override { return 1; }
    std::unique_ptr<ToneMapRunner> make_runner() const override;

private:
    static constexpr int kMaxTileWidth = 1024; // a row stays in L1

    PixelToneMap m_layers;
};

} // namespace srisp
