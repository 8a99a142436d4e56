// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <srisp/image.h>

#include "convolution.h"
#include "model_data.h"
#include "pointwise.h"

namespace srisp {

/// Σ_k weights[k] · atom k of a dictionary layer, kernels and biases alike [P eq. 2, 5]; float32.
ConvolutionWeights mix_layer(const ConvolutionWeights& dictionary, const std::vector<float>& weights);

/// φ, ready to run: kernels mixed and packed.
struct ToneMap {
    std::array<PackedConvolution, kToneLayers> layers;
    int radius = 1; ///< of one kernel: 1 (3×3) or 0 (1×1)

    int halo() const { return radius * kToneLayers; }
};

ToneMap mix_tone_map(const ToneDictionary& dictionary, const std::array<std::vector<float>, kToneLayers>& weights);

/// Computes clamp01(v + φ(v)) for tiles of an image, row by row: each layer keeps the last rows of its input, so
/// activations stay in L2 and no row is computed twice. Every layer replicates the edge of its own input at the border
/// of the image [method 1]. Holds the memory of one thread; nothing is allocated while it runs.
class RollingToneMap {
public:
    /// Columns of a tile at most: with the neighbours that the two 32→32 layers need (190, 192), the widths are nearly
    /// whole blocks of 3 vectors for 4, 8 and 16 lanes; three rows of three layers take 300 KB.
    static constexpr int kMaxTileWidth = 188;

    /// `tone_map` must outlive this object.
    explicit RollingToneMap(const ToneMap& tone_map);

    /// Fills columns [x0, x1) of row y: the first pixel goes to plane(c)[0].
    using LoadRow = std::function<void(int y, int x0, int x1, Planes row)>;
    /// Takes row y of the tile: plane(c)[0] is column tile.x0. The planes have kRowSlack floats of room and may be
    /// changed.
    using StoreRow = std::function<void(int y, Planes row)>;

    /// `tile`: part of an image of width × height pixels, at most kMaxTileWidth wide. `load` is called once per row,
    /// from top to bottom, for the tile and the halo around it as far as the image goes.
    void run(Roi tile, int width, int height, const LoadRow& load, const StoreRow& store);

private:
    /// The last rows of what goes into one layer.
    struct Ring {
        std::vector<float> memory;
        int rows = 3;
        std::ptrdiff_t row_stride = 0, plane_stride = 0;
        int next_row = 0; ///< the first row that was not computed yet
    };
    struct Tile;

    float* ring_pixel(int layer, int x, int y, const Tile& tile);
    void compute_row(int layer, const Tile& tile, const LoadRow& load);
    void compute_rows_up_to(int layer, int y, const Tile& tile, const LoadRow& load);
    void convolve(int layer, int y, int x0, int x1, float* out, std::ptrdiff_t out_plane_stride, const Tile& tile);
    void add_and_clamp(int y, const Tile& tile);

    const ToneMap& m_tone_map;
    std::array<Ring, kToneLayers> m_rings;
    std::vector<float> m_out; // three planes of one row
};

} // namespace srisp
