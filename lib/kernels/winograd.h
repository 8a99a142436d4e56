// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kernels/convolution.h"

namespace srisp {

// A 3×3 convolution of six rows at once by Winograd's minimal filtering F(6, 3) along y [Lavin and Gray 2016]: eight
// input rows are combined into eight others, each is convolved with a kernel of one row, and the results are combined
// into six output rows. 8 · 3 multiply-adds per six outputs and input channel instead of 6 · 9: 2.25 times fewer. Each
// output row takes in rounding errors of all eight input rows, about ten times those of the plain sum.
constexpr int kWinogradOutputs = 6, kWinogradInputs = 8;

/// A layer ready for it.
struct WinogradConvolution {
    std::array<PackedConvolution, kWinogradInputs> parts; ///< kernels of one row of three taps, no bias
    std::vector<float> bias;
};

/// `weights`: of nine taps.
WinogradConvolution pack_winograd(const ConvolutionWeights& weights);

struct WinogradRows {
    const float* in[kWinogradInputs]; ///< pixel left of the first output pixel, channel 0; upper rows first
    std::ptrdiff_t in_plane_stride;   ///< floats between channels
    float* out[kWinogradOutputs];     ///< first output pixel, channel 0; the middle of in[i + 1]
    std::ptrdiff_t out_plane_stride;
    int width; ///< output pixels; up to kRowSlack more may be written
    bool relu;
};

/// Floats of working memory for layers of that many channels at most.
std::size_t winograd_scratch_size(int channels);

/// Six rows of the layer's output, then max(0, ·) where `relu`. Each pixel gets the same bits wherever it lies in the
/// row. Vectorised, dispatched at run time. `scratch`: finite values, of winograd_scratch_size.
void convolve_six_rows(const WinogradConvolution& layer, const WinogradRows& rows, float* scratch);

} // namespace srisp
