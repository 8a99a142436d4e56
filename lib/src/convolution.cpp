// SPDX-License-Identifier: Apache-2.0
#include "convolution.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "convolution.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

HWY_INLINE void store(const ConvolutionRow& row, int output, int outputs, int x, bool relu, V value)
{
    const D d;
    if (output < outputs)
        hn::StoreU(relu ? hn::Max(value, hn::Zero(d)) : value, d, row.out + output * row.out_plane_stride + x);
}

// 4 outputs × 3 vectors of pixels: 12 independent sums hide the latency of the FMA (4–5 cycles × 2 per cycle), and 3
// pixel loads and 4 broadcasts feed 12 of them, so that loads (2 per cycle) are no limit. 12 sums + 3 pixels + 1 weight
// are the 16 registers of AVX2.
HWY_INLINE void block_of_3_vectors(const PackedConvolution& layer, const ConvolutionRow& row, int output, int x)
{
    const D d;
    const int n = static_cast<int>(hn::Lanes(d));
    const float* HWY_RESTRICT w = layer.weights.data() + std::ptrdiff_t(output) * layer.inputs * layer.taps;
    const float* bias = layer.bias.data() + output;
    V a0 = hn::Set(d, bias[0]), a1 = a0, a2 = a0;
    V b0 = hn::Set(d, bias[1]), b1 = b0, b2 = b0;
    V c0 = hn::Set(d, bias[2]), c1 = c0, c2 = c0;
    V e0 = hn::Set(d, bias[3]), e1 = e0, e2 = e0;
    for (int i = 0; i < layer.inputs; ++i) {
        const std::ptrdiff_t offset = i * row.in_plane_stride + x;
        for (int t = 0; t < layer.taps; ++t, w += 4) {
            const float* HWY_RESTRICT in = row.taps[t] + offset;
            const V p0 = hn::LoadU(d, in), p1 = hn::LoadU(d, in + n), p2 = hn::LoadU(d, in + 2 * n);
            const V wa = hn::Set(d, w[0]);
            a0 = hn::MulAdd(wa, p0, a0), a1 = hn::MulAdd(wa, p1, a1), a2 = hn::MulAdd(wa, p2, a2);
            const V wb = hn::Set(d, w[1]);
            b0 = hn::MulAdd(wb, p0, b0), b1 = hn::MulAdd(wb, p1, b1), b2 = hn::MulAdd(wb, p2, b2);
            const V wc = hn::Set(d, w[2]);
            c0 = hn::MulAdd(wc, p0, c0), c1 = hn::MulAdd(wc, p1, c1), c2 = hn::MulAdd(wc, p2, c2);
            const V we = hn::Set(d, w[3]);
            e0 = hn::MulAdd(we, p0, e0), e1 = hn::MulAdd(we, p1, e1), e2 = hn::MulAdd(we, p2, e2);
        }
    }
    const V sums[] = { a0, a1, a2, b0, b1, b2, c0, c1, c2, e0, e1, e2 };
    for (int o = 0; o < 4; ++o)
        for (int k = 0; k < 3; ++k)
            store(row, output + o, layer.outputs, x + k * n, row.relu, sums[o * 3 + k]);
}

/// 4 outputs × 1 vector: the end of a row.
HWY_INLINE void block_of_1_vector(const PackedConvolution& layer, const ConvolutionRow& row, int output, int x)
{
    const D d;
    const float* HWY_RESTRICT w = layer.weights.data() + std::ptrdiff_t(output) * layer.inputs * layer.taps;
    const float* bias = layer.bias.data() + output;
    V a = hn::Set(d, bias[0]), b = hn::Set(d, bias[1]), c = hn::Set(d, bias[2]), e = hn::Set(d, bias[3]);
    for (int i = 0; i < layer.inputs; ++i)
        for (int t = 0; t < layer.taps; ++t, w += 4) {
            const V p = hn::LoadU(d, row.taps[t] + i * row.in_plane_stride + x);
            a = hn::MulAdd(hn::Set(d, w[0]), p, a);
            b = hn::MulAdd(hn::Set(d, w[1]), p, b);
            c = hn::MulAdd(hn::Set(d, w[2]), p, c);
            e = hn::MulAdd(hn::Set(d, w[3]), p, e);
        }
    store(row, output, layer.outputs, x, row.relu, a);
    store(row, output + 1, layer.outputs, x, row.relu, b);
    store(row, output + 2, layer.outputs, x, row.relu, c);
    store(row, output + 3, layer.outputs, x, row.relu, e);
}

// Pixels outside, outputs inside: the inputs of one pixel block (9–15 KB for 32 channels) stay in L1 while the weights
// (37 KB) stream from L2, 37 KB for every 13,800 cycles of arithmetic.
void convolve_row(const PackedConvolution& layer, const ConvolutionRow& row)
{
    const int n = static_cast<int>(hn::Lanes(D()));
    int x = 0;
    for (; row.width - x > 2 * n; x += 3 * n)
        for (int output = 0; output < layer.outputs; output += 4)
            block_of_3_vectors(layer, row, output, x);
    for (; x < row.width; x += n)
        for (int output = 0; output < layer.outputs; output += 4)
            block_of_1_vector(layer, row, output, x);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(convolve_row);

void convolve_row(const PackedConvolution& layer, const ConvolutionRow& row)
{
    HWY_DYNAMIC_DISPATCH(convolve_row)(layer, row);
}

void convolve_row_scalar(const PackedConvolution& layer, const ConvolutionRow& row)
{
    for (int o = 0; o < layer.outputs; ++o)
        for (int x = 0; x < row.width; ++x) {
            const float* w = layer.weights.data() + std::ptrdiff_t(o / 4 * 4) * layer.inputs * layer.taps + o % 4;
            float sum = layer.bias[o];
            for (int i = 0; i < layer.inputs; ++i)
                for (int t = 0; t < layer.taps; ++t, w += 4)
                    sum = std::fma(*w, row.taps[t][i * row.in_plane_stride + x], sum);
            row.out[o * row.out_plane_stride + x] = row.relu ? std::max(sum, 0.0f) : sum;
        }
}

PackedConvolution pack_convolution(const float* weights, const float* bias, int outputs, int inputs, int taps)
{
    PackedConvolution packed{ inputs, outputs, taps, {}, {} };
    const int padded = (outputs + 3) / 4 * 4;
    packed.weights.assign(std::size_t(padded) * inputs * taps, 0.0f);
    packed.bias.assign(padded, 0.0f);
    std::copy_n(bias, outputs, packed.bias.begin());
    for (int o = 0; o < outputs; ++o)
        for (int it = 0; it < inputs * taps; ++it)
            packed.weights[(std::size_t(o / 4) * inputs * taps + it) * 4 + o % 4] = weights[o * inputs * taps + it];
    return packed;
}

} // namespace srisp
#endif
