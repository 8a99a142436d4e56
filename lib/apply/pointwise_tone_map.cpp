// SPDX-License-Identifier: Apache-2.0
#include "apply/pointwise_tone_map.h"

#include "apply/tile_rows.h"

namespace srisp {

namespace {

class PointwiseRunner : public ToneMapRunner {
public:
    PointwiseRunner(const PixelToneMap& layers, int max_tile_width)
        : m_layers(layers), m_stride(RowRing::plane_stride(max_tile_width)), m_values(3 * m_stride)
    {
    }

    void run(Roi tile, int, int, LoadRow load, StoreRow store) override
    {
        const Planes row{ m_values.data(), m_stride };
        const std::size_t count = tile.x1 - tile.x0;
        for (int y = tile.y0; y < tile.y1; ++y) {
            load(y, tile.x0, tile.x1, row);
            tone_map_pixels(m_layers, row, row, count);
            clamp01(row, row, count);
            store(y, row);
        }
    }

private:
    const PixelToneMap& m_layers;
    std::ptrdiff_t m_stride;
    std::vector<float> m_values;
};

} // namespace

std::unique_ptr<ToneMapRunner> PointwiseToneMap::make_runner() const
{
    return std::make_unique<PointwiseRunner>(m_layers, kMaxTileWidth);
}

} // namespace srisp
