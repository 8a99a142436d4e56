// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set, by Highway's convention for such files.
#if defined(SRISP_CONVOLUTION_BLOCKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SRISP_CONVOLUTION_BLOCKS_INL_H_
#undef SRISP_CONVOLUTION_BLOCKS_INL_H_
#else
#define SRISP_CONVOLUTION_BLOCKS_INL_H_
#endif

#include <limits>

#include <hwy/highway.h>

#include "kernels/convolution.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

// A block is kOutputs channels × kVectors vectors of pixels, whose sums stay in registers. Each tap loads kVectors
// pixels and broadcasts kOutputs weights for kOutputs × kVectors FMAs. Two FMAs start per cycle, and two loads (an
// unaligned one counts twice where it straddles cache lines); 10 independent sums hide the latency of an FMA, 4–5
// cycles. 16 registers (AVX2): 12 sums, 3 pixels, 1 weight; 7 loads for 12 FMAs. 32 registers of 64 bytes (AVX-512),
// where nearly every unaligned load straddles: 8 × 3 takes 11 loads for 24. A layer of 3 outputs gets a shape in which
// none is padding.
#if HWY_TARGET <= HWY_AVX3
constexpr int kBlockOutputs = 8;
#else
constexpr int kBlockOutputs = 4;
#endif
constexpr int kBlockVectors = 3;
static_assert(kBlockVectors == 3, "whole_row has a shape for what is left of a block: 1 or 2 vectors");

template<int kOutputs, int kVectors>
HWY_INLINE void block(const PackedConvolution& layer, const ConvolutionRow& row, int output, int x)
{
    const D d;
    const int n = static_cast<int>(hn::Lanes(d));
    const std::ptrdiff_t group = std::ptrdiff_t(kWeightGroup) * layer.inputs * layer.taps;
    const float* HWY_RESTRICT w = layer.weights.data() + output / kWeightGroup * group;
    V sums[kOutputs][kVectors];
    for (int o = 0; o < kOutputs; ++o)
        for (int k = 0; k < kVectors; ++k)
            sums[o][k] = hn::Set(d, layer.bias[output + o]);
    for (int i = 0; i < layer.inputs; ++i) {
        const std::ptrdiff_t offset = i * row.in_plane_stride + x;
        for (int t = 0; t < layer.taps; ++t, w += kWeightGroup) {
            const float* HWY_RESTRICT in = row.taps[t] + offset;
            V pixels[kVectors];
            for (int k = 0; k < kVectors; ++k)
                pixels[k] = hn::LoadU(d, in + k * n);
            for (int o = 0; o < kOutputs; ++o) {
                const V weight = hn::Set(d, w[o / kWeightGroup * group + o % kWeightGroup]);
                for (int k = 0; k < kVectors; ++k)
                    sums[o][k] = hn::MulAdd(weight, pixels[k], sums[o][k]);
            }
        }
    }
    const V lowest = hn::Set(d, row.relu ? 0.0f : -std::numeric_limits<float>::infinity());
    for (int o = 0; o < kOutputs && output + o < layer.outputs; ++o)
        for (int k = 0; k < kVectors; ++k)
            hn::StoreU(hn::Max(sums[o][k], lowest), d, row.out + (output + o) * row.out_plane_stride + x + k * n);
}

/// All outputs of kVectors vectors of pixels.
template<int kOutputs, int kVectors>
HWY_INLINE void all_outputs(const PackedConvolution& layer, const ConvolutionRow& row, int x)
{
    for (int output = 0; output < layer.outputs; output += kOutputs)
        block<kOutputs, kVectors>(layer, row, output, x);
}

// Pixels outside, outputs inside: the inputs of one pixel block (9–15 KB for 32 channels) stay in L1 while the weights
// (37 KB) stream from L2, 37 KB for every 13,800 cycles of arithmetic. The end of a row, and rows of few pixels, take
// narrower blocks, with enough outputs to hide the latency.
template<int kOutputs, int kOutputsAtEnd>
HWY_INLINE void whole_row(const PackedConvolution& layer, const ConvolutionRow& row)
{
    const int n = static_cast<int>(hn::Lanes(D()));
    int x = 0;
    for (; row.width - x > (kBlockVectors - 1) * n; x += kBlockVectors * n)
        all_outputs<kOutputs, kBlockVectors>(layer, row, x);
    if (row.width - x > n) {
        all_outputs<kOutputs, 2>(layer, row, x);
        x += 2 * n;
    }
    if (row.width > x)
        all_outputs<kOutputsAtEnd, 1>(layer, row, x);
}

/// What convolve_row does, in the best shape for the layer.
HWY_INLINE void convolve_blocks(const PackedConvolution& layer, const ConvolutionRow& row)
{
    if (layer.outputs <= 3)
        whole_row<3, 3>(layer, row);
    else
        whole_row<kBlockOutputs, kWidestBlock>(layer, row);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#endif
