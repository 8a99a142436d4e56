// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <OpenImageIO/function_view.h>
#include <srisp/apply.h>
#include <srisp/image.h>

#include "kernels/pointwise.h"
#include "model/model_data.h"

namespace srisp {

/// Computes clamp01(v + φ(v)) for tiles of an image, row by row: each layer keeps the last rows of its input, so
/// activations stay in L2. Every layer replicates the edge of its own input at the border of the image [method 1].
/// Holds the memory of one thread; nothing is allocated while it runs.
class ToneMapRunner {
public:
    virtual ~ToneMapRunner() = default;

    /// Fills columns [x0, x1) of row y: the first pixel goes to plane(c)[0].
    using LoadRow = OIIO::function_view<void(int y, int x0, int x1, Planes row)>;
    /// Takes row y of the tile: plane(c)[0] is column tile.x0. The planes have kRowSlack floats of room and may be
    /// changed.
    using StoreRow = OIIO::function_view<void(int y, Planes row)>;

    /// `tile`: part of an image of width × height pixels, at most ToneMap::max_tile_width() wide. `load` is called once
    /// per row, from top to bottom, for the tile and the halo around it as far as the image goes.
    virtual void run(Roi tile, int width, int height, LoadRow load, StoreRow store) = 0;
};

/// φ, ready to run: kernels mixed and packed. Immutable.
class ToneMap {
public:
    virtual ~ToneMap() = default;

    /// Neighbours that a tile needs around it.
    virtual int halo() const = 0;
    virtual int max_tile_width() const = 0;
    /// Rows of a tile that make what is computed twice at its top and bottom cheap.
    virtual int good_tile_height() const = 0;
    /// The runner must not outlive the tone map.
    virtual std::unique_ptr<ToneMapRunner> make_runner() const = 0;
};

/// Σ_k weights[k] · atom k of a dictionary layer, kernels and biases alike [P eq. 2, 5]; float32.
ConvolutionWeights mix_layer(const ConvolutionWeights& dictionary, const std::vector<float>& weights);

/// The same for all layers of a tone map.
std::array<ConvolutionWeights, kToneLayers> mix_layers(const ToneDictionary& dictionary,
                                                       const std::array<std::vector<float>, kToneLayers>& weights);

/// How 3×3 kernels are computed; 1×1 kernels are always plain sums.
enum class ToneMethod {
    plain,    ///< plain sums in float32
    winograd, ///< fewer multiply-adds, in float32
    bf16      ///< dot products of bf16; only where has_bf16()
};

/// The method of a precision on this processor.
ToneMethod tone_method(Precision precision);

std::unique_ptr<const ToneMap> mix_tone_map(const ToneDictionary& dictionary,
                                            const std::array<std::vector<float>, kToneLayers>& weights,
                                            ToneMethod method);

} // namespace srisp
