// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "base/planes.h"
#include "model/model_data.h"

namespace srisp {

/// Outputs whose weights lie side by side; the most that a kernel computes at once.
constexpr int kWeightGroup = 4, kWidestBlock = 8;

/// A convolution layer with its weights in the order in which the kernel reads them.
struct PackedConvolution {
    int inputs = 0, outputs = 0, taps = 0; ///< channels in and out; taps = kernel height × width (1 or 9)
    std::vector<float> weights;            ///< [output / 4][input][tap][4], padded to a multiple of kWidestBlock with 0
    std::vector<float> bias;               ///< [output], padded likewise
};

PackedConvolution pack_convolution(const ConvolutionWeights& weights);

/// Where one output row takes its inputs from and where it goes. Channels are planes.
struct ConvolutionRow {
    const float* taps[9];           ///< input of tap t for output pixel 0, channel 0; kernel rows first
    std::ptrdiff_t in_plane_stride; ///< floats between channels
    float* out;
    std::ptrdiff_t out_plane_stride;
    int width; ///< output pixels; up to kRowSlack more may be written
    bool relu;
};

/// out[o][x] = bias[o] + Σ_i Σ_t w[o][i][t] · taps[t][i][x], then max(0, ·) where `relu`; cross-correlation (no flip).
/// The sums run over i, then t, so each pixel gets the same bits wherever it lies in the row. Vectorised, dispatched at
/// run time.
void convolve_row(const PackedConvolution& layer, const ConvolutionRow& row);

/// The same in plain C++: what the vectorised form is tested against. Writes `width` pixels.
void convolve_row_scalar(const PackedConvolution& layer, const ConvolutionRow& row);

} // namespace srisp
