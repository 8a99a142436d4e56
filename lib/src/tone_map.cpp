// SPDX-License-Identifier: Apache-2.0
#include "tone_map.h"

#include <algorithm>

namespace srisp {

namespace {

constexpr int kLeftRoom = 8; // floats before a tile's first column: the halo of 4, the replicated edge, and some
constexpr int kPlaneStride = kLeftRoom + RollingToneMap::kMaxTileWidth + kLeftRoom + kRowSlack;

} // namespace

struct RollingToneMap::Tile {
    Roi roi;
    int width, height; // of the image

    int clamp_row(int y) const { return std::clamp(y, 0, height - 1); }
};

ConvolutionWeights mix_layer(const ConvolutionWeights& dictionary, const std::vector<float>& weights)
{
    ConvolutionWeights mixed{ dictionary.inputs, dictionary.outputs, dictionary.taps, {}, {} };
    const auto mix = [&](const std::vector<float>& atoms, std::vector<float>& out) {
        const std::size_t size = atoms.size() / weights.size();
        out.assign(size, 0.0f);
        for (std::size_t k = 0; k < weights.size(); ++k)
            for (std::size_t i = 0; i < size; ++i)
                out[i] += weights[k] * atoms[k * size + i];
    };
    mix(dictionary.weight, mixed.weight);
    mix(dictionary.bias, mixed.bias);
    return mixed;
}

ToneMap mix_tone_map(const ToneDictionary& dictionary, const std::array<std::vector<float>, kToneLayers>& weights)
{
    ToneMap tone_map;
    for (int l = 0; l < kToneLayers; ++l) {
        const ConvolutionWeights mixed = mix_layer(dictionary[l], weights[l]);
        tone_map.layers[l] =
            pack_convolution(mixed.weight.data(), mixed.bias.data(), mixed.outputs, mixed.inputs, mixed.taps);
    }
    tone_map.radius = tone_map.layers[0].taps == 9 ? 1 : 0;
    return tone_map;
}

RollingToneMap::RollingToneMap(const ToneMap& tone_map) : m_tone_map(tone_map), m_out(3 * kPlaneStride)
{
    for (int l = 0; l < kToneLayers; ++l) {
        Ring& ring = m_rings[l];
        ring.plane_stride = kPlaneStride;
        ring.row_stride = std::ptrdiff_t(kPlaneStride) * tone_map.layers[l].inputs;
        // A kernel needs three rows; v itself is needed again when φ is known, and the input is then a halo ahead.
        ring.rows = l == 0 ? kToneLayers + 1 : 3;
        ring.memory.assign(ring.row_stride * ring.rows, 0.0f);
    }
}

/// Where pixel (x, y) of the image lies in the input of a layer, channel 0.
float* RollingToneMap::ring_pixel(int layer, int x, int y, const Tile& tile)
{
    Ring& ring = m_rings[layer];
    return ring.memory.data() + y % ring.rows * ring.row_stride + kLeftRoom + x - tile.roi.x0;
}

/// Output pixels [x0, x1) of row y of a layer.
void RollingToneMap::convolve(int layer, int y, int x0, int x1, float* out, std::ptrdiff_t out_plane_stride,
                              const Tile& tile)
{
    ConvolutionRow row{};
    const int radius = m_tone_map.radius;
    for (int dy = -radius, t = 0; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx, ++t)
            row.taps[t] = ring_pixel(layer, x0 + dx, tile.clamp_row(y + dy), tile);
    row.in_plane_stride = m_rings[layer].plane_stride;
    row.out = out;
    row.out_plane_stride = out_plane_stride;
    row.width = x1 - x0;
    row.relu = layer < kToneLayers - 1;
    convolve_row(m_tone_map.layers[layer], row);
}

/// The next row of what goes into `layer`: from the image (layer 0) or from the layer before.
void RollingToneMap::compute_row(int layer, const Tile& tile, const LoadRow& load)
{
    Ring& ring = m_rings[layer];
    const int y = ring.next_row++;
    const int needed = (kToneLayers - layer) * m_tone_map.radius; // columns beside the tile
    const int x0 = std::max(tile.roi.x0 - needed, 0), x1 = std::min(tile.roi.x1 + needed, tile.width);
    float* row = ring_pixel(layer, x0, y, tile);
    if (layer == 0)
        load(y, x0, x1, { row, ring.plane_stride });
    else
        convolve(layer - 1, y, x0, x1, row, ring.plane_stride, tile);
    for (int channel = 0; channel < m_tone_map.layers[layer].inputs; ++channel, row += ring.plane_stride) {
        if (x0 == 0)
            row[-1] = row[0];
        if (x1 == tile.width)
            row[x1 - x0] = row[x1 - x0 - 1];
    }
}

void RollingToneMap::compute_rows_up_to(int layer, int y, const Tile& tile, const LoadRow& load)
{
    for (Ring& ring = m_rings[layer]; ring.next_row <= y;) {
        if (layer > 0)
            compute_rows_up_to(layer - 1, tile.clamp_row(ring.next_row + m_tone_map.radius), tile, load);
        compute_row(layer, tile, load);
    }
}

/// m_out = clamp01(v + φ(v)) for row y, φ being in m_out.
void RollingToneMap::add_and_clamp(int y, const Tile& tile)
{
    const float* v = ring_pixel(0, tile.roi.x0, y, tile);
    for (int c = 0; c < 3; ++c)
        for (int x = 0; x < tile.roi.x1 - tile.roi.x0; ++x) {
            float& out = m_out[c * kPlaneStride + x];
            out = std::min(std::max(v[c * m_rings[0].plane_stride + x] + out, 0.0f), 1.0f);
        }
}

void RollingToneMap::run(Roi roi, int width, int height, const LoadRow& load, const StoreRow& store)
{
    const Tile tile{ roi, width, height };
    const int radius = m_tone_map.radius;
    for (int l = 0; l < kToneLayers; ++l)
        m_rings[l].next_row = std::max(roi.y0 - (kToneLayers - l) * radius, 0);
    for (int y = roi.y0; y < roi.y1; ++y) {
        compute_rows_up_to(kToneLayers - 1, tile.clamp_row(y + radius), tile, load);
        convolve(kToneLayers - 1, y, roi.x0, roi.x1, m_out.data(), kPlaneStride, tile);
        add_and_clamp(y, tile);
        store(y, { m_out.data(), kPlaneStride });
    }
}

} // namespace srisp
