// SPDX-License-Identifier: Apache-2.0
#include "kernels/bf16_convolution.h"

#include <cstdint>
#include <cstring>
#include <limits>

#if defined(__x86_64__)
#include <hwy/targets.h>
#include <immintrin.h>
#endif

namespace srisp {

namespace {

std::uint32_t bits_of(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

float float_of(std::uint32_t bits)
{
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// The upper half of a finite float32, rounded to nearest even.
std::uint32_t rounded_to_bf16(float value)
{
    const std::uint32_t bits = bits_of(value);
    return (bits + 0x7fff + (bits >> 16 & 1)) >> 16;
}

} // namespace

float bf16_pair(float even, float odd)
{
    return float_of(rounded_to_bf16(even) | rounded_to_bf16(odd) << 16);
}

float even_of_pair(float pair)
{
    return float_of(bits_of(pair) << 16);
}

float odd_of_pair(float pair)
{
    return float_of(bits_of(pair) & 0xffff0000);
}

PackedConvolution pack_bf16(const ConvolutionWeights& weights)
{
    ConvolutionWeights pairs{ weights.inputs / 2, weights.outputs, weights.taps, {}, weights.bias };
    const int taps = weights.taps;
    for (int o = 0; o < weights.outputs; ++o)
        for (int i = 0; i < weights.inputs; i += 2)
            for (int t = 0; t < taps; ++t) {
                const float* const even = &weights.weight[std::size_t(o * weights.inputs + i) * taps + t];
                pairs.weight.push_back(bf16_pair(even[0], even[taps]));
            }
    return pack_convolution(pairs);
}

#if defined(__x86_64__)

// Functions for a processor of their own in a file for all: flags for the file would change the inline functions that
// it shares with others.
#define SRISP_BF16 __attribute__((target("avx512f,avx512bw,avx512bf16")))

bool has_bf16()
{
    return (hwy::SupportedTargets() & (HWY_AVX3 | HWY_AVX3_DL)) && __builtin_cpu_supports("avx512bf16");
}

namespace {

enum class Values { floats, pairs };

constexpr int kLanes = 16;

// As in convolution_blocks-inl.h: kOutputs × kVectors sums stay in the 32 registers, at most 24 of them; a dot product
// starts every cycle and takes six. Of 11 loads for 24 dot products, 8 are broadcasts of a weight.
constexpr int kBlockOutputs = 8, kBlockVectors = 3;

template<Values kIn> SRISP_BF16 inline __m512 multiply_add(__m512 weight, __m512 pixels, __m512 sum)
{
    if constexpr (kIn == Values::pairs)
        return _mm512_dpbf16_ps(sum, (__m512bh)pixels, (__m512bh)weight);
    else
        return _mm512_fmadd_ps(weight, pixels, sum);
}

/// Two channels of 16 pixels as pairs.
SRISP_BF16 inline __m512 paired(__m512 even, __m512 odd)
{
    const __m512i interleave = _mm512_set_epi16(31, 15, 30, 14, 29, 13, 28, 12, 27, 11, 26, 10, 25, 9, 24, 8, 23, 7, 22,
                                                6, 21, 5, 20, 4, 19, 3, 18, 2, 17, 1, 16, 0);
    return _mm512_castsi512_ps(_mm512_permutexvar_epi16(interleave, (__m512i)_mm512_cvtne2ps_pbh(odd, even)));
}

template<Values kIn, Values kOut, int kOutputs, int kVectors>
SRISP_BF16 inline void block(const PackedConvolution& layer, const ConvolutionRow& row, int output, int x)
{
    const std::ptrdiff_t group = std::ptrdiff_t(kWeightGroup) * layer.inputs * layer.taps;
    const float* __restrict w = layer.weights.data() + output / kWeightGroup * group;
    __m512 sums[kOutputs][kVectors];
    for (int o = 0; o < kOutputs; ++o)
        for (int k = 0; k < kVectors; ++k)
            sums[o][k] = _mm512_set1_ps(layer.bias[output + o]);
    for (int i = 0; i < layer.inputs; ++i) {
        const std::ptrdiff_t offset = i * row.in_plane_stride + x;
        for (int t = 0; t < layer.taps; ++t, w += kWeightGroup) {
            const float* __restrict in = row.taps[t] + offset;
            __m512 pixels[kVectors];
            for (int k = 0; k < kVectors; ++k)
                pixels[k] = _mm512_loadu_ps(in + k * kLanes);
            for (int o = 0; o < kOutputs; ++o) {
                const __m512 weight = _mm512_set1_ps(w[o / kWeightGroup * group + o % kWeightGroup]);
                for (int k = 0; k < kVectors; ++k)
                    sums[o][k] = multiply_add<kIn>(weight, pixels[k], sums[o][k]);
            }
        }
    }
    const __m512 lowest = _mm512_set1_ps(row.relu ? 0.0f : -std::numeric_limits<float>::infinity());
    for (int o = 0; o < kOutputs; ++o)
        for (int k = 0; k < kVectors; ++k)
            sums[o][k] = _mm512_maskz_max_ps(0xffff, sums[o][k], lowest); // plain _mm512_max_ps makes GCC 12 warn
    if constexpr (kOut == Values::pairs) {
        for (int o = 0; o < kOutputs && output + o < layer.outputs; o += 2)
            for (int k = 0; k < kVectors; ++k)
                _mm512_storeu_ps(row.out + (output + o) / 2 * row.out_plane_stride + x + k * kLanes,
                                 paired(sums[o][k], sums[o + 1][k]));
    } else {
        for (int o = 0; o < kOutputs && output + o < layer.outputs; ++o)
            for (int k = 0; k < kVectors; ++k)
                _mm512_storeu_ps(row.out + (output + o) * row.out_plane_stride + x + k * kLanes, sums[o][k]);
    }
}

/// Blocks along the row; its end takes narrower ones.
template<Values kIn, Values kOut, int kOutputs>
SRISP_BF16 inline void whole_row(const PackedConvolution& layer, const ConvolutionRow& row)
{
    for (int x = 0; x < row.width; x += kBlockVectors * kLanes)
        for (int output = 0; output < layer.outputs; output += kOutputs)
            if (row.width - x > 2 * kLanes)
                block<kIn, kOut, kOutputs, 3>(layer, row, output, x);
            else if (row.width - x > kLanes)
                block<kIn, kOut, kOutputs, 2>(layer, row, output, x);
            else
                block<kIn, kOut, kOutputs, 1>(layer, row, output, x);
}

} // namespace

SRISP_BF16 void convolve_floats_to_pairs(const PackedConvolution& layer, const ConvolutionRow& row)
{
    whole_row<Values::floats, Values::pairs, kBlockOutputs>(layer, row);
}

SRISP_BF16 void convolve_pairs_to_pairs(const PackedConvolution& layer, const ConvolutionRow& row)
{
    whole_row<Values::pairs, Values::pairs, kBlockOutputs>(layer, row);
}

SRISP_BF16 void convolve_pairs_to_floats(const PackedConvolution& layer, const ConvolutionRow& row)
{
    if (layer.outputs <= 3)
        whole_row<Values::pairs, Values::floats, 3>(layer, row);
    else
        whole_row<Values::pairs, Values::floats, kBlockOutputs>(layer, row);
}

#else // never called there

bool has_bf16()
{
    return false;
}

void convolve_floats_to_pairs(const PackedConvolution&, const ConvolutionRow&) {}
void convolve_pairs_to_pairs(const PackedConvolution&, const ConvolutionRow&) {}
void convolve_pairs_to_floats(const PackedConvolution&, const ConvolutionRow&) {}

#endif

} // namespace srisp
