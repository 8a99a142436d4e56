// SPDX-License-Identifier: Apache-2.0
#include "kernels/winograd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/winograd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

#include "kernels/convolution_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// a · b + c
HWY_INLINE V multiply_add(float a, V b, V c)
{
    return hn::MulAdd(hn::Set(D(), a), b, c);
}

// Interpolation at 0, ±1, ±2, ±1/2 and infinity. Rows of a pair ± share their even and odd parts.
HWY_INLINE void combine_inputs(const V d[8], V out[8])
{
    const auto pair = [out](int first, V even, V odd) {
        out[first] = hn::Add(even, odd);
        out[first + 1] = hn::Sub(even, odd);
    };
    const D tag;
    out[0] = multiply_add(5.25f, hn::Sub(d[4], d[2]), hn::Sub(d[0], d[6]));
    pair(1, multiply_add(-4.25f, d[4], hn::Add(d[2], d[6])), multiply_add(-4.25f, d[3], hn::Add(d[1], d[5])));
    pair(3, multiply_add(-1.25f, d[4], multiply_add(0.25f, d[2], d[6])),
         multiply_add(2.0f, d[5], multiply_add(-2.5f, d[3], hn::Mul(hn::Set(tag, 0.5f), d[1]))));
    pair(5, multiply_add(-5.0f, d[4], multiply_add(4.0f, d[2], d[6])),
         multiply_add(0.5f, d[5], multiply_add(-2.5f, d[3], hn::Add(d[1], d[1]))));
    out[7] = multiply_add(5.25f, hn::Sub(d[3], d[5]), hn::Sub(d[7], d[1]));
}

HWY_INLINE void combine_outputs(const V m[8], V bias, V out[6])
{
    const V one = hn::Add(m[1], m[2]), odd_one = hn::Sub(m[1], m[2]);
    const V two = hn::Add(m[3], m[4]), odd_two = hn::Sub(m[3], m[4]);
    const V half = hn::Add(m[5], m[6]), odd_half = hn::Sub(m[5], m[6]);
    const V even_base = hn::Add(one, bias), odd_base = hn::Add(odd_one, bias);
    out[0] = hn::Add(hn::Add(m[0], even_base), hn::Add(two, half));
    out[1] = multiply_add(0.5f, odd_half, multiply_add(2.0f, odd_two, odd_base));
    out[2] = multiply_add(0.25f, half, multiply_add(4.0f, two, even_base));
    out[3] = multiply_add(0.125f, odd_half, multiply_add(8.0f, odd_two, odd_base));
    out[4] = multiply_add(1.0f / 16, half, multiply_add(16.0f, two, even_base));
    out[5] = hn::Add(m[7], multiply_add(1.0f / 32, odd_half, multiply_add(32.0f, odd_two, odd_base)));
}

// The rows are cut into spans of two kernel blocks: of a span, 8 combined rows × 32 channels (57 KB with AVX2) and as
// many products stay in L2, while the eighth that one kernel works on stays in L1 with its weights (7 and 12 KB).
HWY_INLINE void convolve_span(const WinogradConvolution& layer, const WinogradRows& rows, int x, int span,
                              float* combined)
{
    const D d;
    const int n = static_cast<int>(hn::Lanes(d));
    const int inputs = layer.parts[0].inputs, outputs = layer.parts[0].outputs;
    const int in_stride = span + (n > 1 ? n : 2); // whole vectors, two pixels more than the span at least
    const std::ptrdiff_t in_row = std::ptrdiff_t(in_stride) * inputs, out_row = std::ptrdiff_t(span) * outputs;
    float* const products = combined + kWinogradInputs * in_row;
    const V lowest = hn::Set(d, rows.relu ? 0.0f : -std::numeric_limits<float>::infinity());
    V from[8], to[8];
    for (int i = 0; i < inputs; ++i)
        for (int v = 0; v < in_stride; v += n) {
            for (int k = 0; k < kWinogradInputs; ++k)
                from[k] = hn::LoadU(d, rows.in[k] + i * rows.in_plane_stride + x + v);
            combine_inputs(from, to);
            for (int k = 0; k < kWinogradInputs; ++k)
                hn::StoreU(to[k], d, combined + k * in_row + i * in_stride + v);
        }
    for (int k = 0; k < kWinogradInputs; ++k) {
        const float* in = combined + k * in_row;
        convolve_blocks(layer.parts[k],
                        { { in, in + 1, in + 2 }, in_stride, products + k * out_row, span, span, false });
    }
    for (int o = 0; o < outputs; ++o)
        for (int v = 0; v < span; v += n) {
            for (int k = 0; k < kWinogradInputs; ++k)
                from[k] = hn::LoadU(d, products + k * out_row + o * span + v);
            combine_outputs(from, hn::Set(d, layer.bias[o]), to);
            for (int k = 0; k < kWinogradOutputs; ++k)
                hn::StoreU(hn::Max(to[k], lowest), d, rows.out[k] + o * rows.out_plane_stride + x + v);
        }
}

void convolve_six_rows(const WinogradConvolution& layer, const WinogradRows& rows, float* scratch)
{
    const int block = kBlockVectors * static_cast<int>(hn::Lanes(D()));
    for (int x = 0; x < rows.width; x += 2 * block)
        convolve_span(layer, rows, x, rows.width - x > block ? 2 * block : block, scratch);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(convolve_six_rows);

void convolve_six_rows(const WinogradConvolution& layer, const WinogradRows& rows, float* scratch)
{
    HWY_DYNAMIC_DISPATCH(convolve_six_rows)(layer, rows, scratch);
}

std::size_t winograd_scratch_size(int channels)
{
    constexpr std::size_t widest = 2 * kRowSlack; // pixels of a span and a vector more, at most
    return 2 * kWinogradInputs * widest * std::size_t(channels);
}

WinogradConvolution pack_winograd(const ConvolutionWeights& w)
{
    static constexpr double transform[kWinogradInputs][3] = {
        { 1, 0, 0 },
        { -2.0 / 9, -2.0 / 9, -2.0 / 9 },
        { -2.0 / 9, 2.0 / 9, -2.0 / 9 },
        { 1.0 / 90, 1.0 / 45, 2.0 / 45 },
        { 1.0 / 90, -1.0 / 45, 2.0 / 45 },
        { 32.0 / 45, 16.0 / 45, 8.0 / 45 },
        { 32.0 / 45, -16.0 / 45, 8.0 / 45 },
        { 0, 0, 1 },
    };
    WinogradConvolution packed;
    packed.bias = w.bias;
    for (int k = 0; k < kWinogradInputs; ++k) {
        ConvolutionWeights part{ w.inputs, w.outputs, 3, {}, std::vector<float>(w.bias.size(), 0.0f) };
        for (std::size_t kernel = 0; kernel < w.weight.size(); kernel += 9)
            for (int x = 0; x < 3; ++x) {
                double sum = 0;
                for (int y = 0; y < 3; ++y)
                    sum += transform[k][y] * w.weight[kernel + y * 3 + x];
                part.weight.push_back(static_cast<float>(sum));
            }
        packed.parts[k] = pack_convolution(part);
    }
    return packed;
}

} // namespace srisp
#endif
