// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set, by Highway's convention for such files.
#if defined(SRISP_PIXEL_TONE_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SRISP_PIXEL_TONE_MAP_INL_H_
#undef SRISP_PIXEL_TONE_MAP_INL_H_
#else
#define SRISP_PIXEL_TONE_MAP_INL_H_
#endif

#include <limits>

#include <hwy/highway.h>

#include "kernels/convolution_blocks-inl.h"
#include "kernels/pixel_tone_map.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Pixels that go through all layers before the next ones: their 32 channels take 3 KB with AVX2 and 6 with AVX-512,
/// and all weights 9 KB, so everything stays in L1.
constexpr int kPixelBlock = kBlockVectors * static_cast<int>(hn::MaxLanes(D()));

/// Channels of a block, one after another.
template<int kChannels> struct BlockChannels {
    HWY_ALIGN float values[kChannels * kPixelBlock];

    Planes planes() { return { values, kPixelBlock }; }
    float* at(int channel, int x) { return values + channel * kPixelBlock + x; }
};
using BlockRgb = BlockChannels<3>;

/// As block() in convolution_blocks-inl.h, where all sizes are known: nothing but loads, broadcasts and multiply-adds.
template<int kInputs, int kAllOutputs, int kOutputs> HWY_INLINE void
run_layer(const PackedConvolution& layer, const float* HWY_RESTRICT in, float* HWY_RESTRICT out, V lowest)
{
    const D d;
    constexpr int n = static_cast<int>(hn::MaxLanes(d)), group = kWeightGroup * kInputs;
    for (int output = 0; output < kAllOutputs; output += kOutputs) {
        const float* HWY_RESTRICT w = layer.weights.data() + output * kInputs;
        V sums[kOutputs][kBlockVectors];
        for (int o = 0; o < kOutputs; ++o)
            for (int k = 0; k < kBlockVectors; ++k)
                sums[o][k] = hn::Set(d, layer.bias[output + o]);
        for (int i = 0; i < kInputs; ++i, w += kWeightGroup) {
            V pixels[kBlockVectors];
            for (int k = 0; k < kBlockVectors; ++k)
                pixels[k] = hn::Load(d, in + i * kPixelBlock + k * n);
            for (int o = 0; o < kOutputs; ++o) {
                const V weight = hn::Set(d, w[o / kWeightGroup * group + o % kWeightGroup]);
                for (int k = 0; k < kBlockVectors; ++k)
                    sums[o][k] = hn::MulAdd(weight, pixels[k], sums[o][k]);
            }
        }
        for (int o = 0; o < kOutputs; ++o)
            for (int k = 0; k < kBlockVectors; ++k)
                hn::Store(hn::Max(sums[o][k], lowest), d, out + (output + o) * kPixelBlock + k * n);
    }
}

/// φ of a block. Not inline: what calls it twice should find one copy in the instruction cache.
static HWY_NOINLINE void tone_map_block(const PixelToneMap& layers, const BlockRgb& v, BlockRgb& phi)
{
    BlockChannels<kToneChannels> a, b;
    const V zero = hn::Zero(D()), none = hn::Set(D(), -std::numeric_limits<float>::infinity());
    run_layer<3, kToneChannels, kBlockOutputs>(layers[0], v.values, a.values, zero);
    run_layer<kToneChannels, kToneChannels, kBlockOutputs>(layers[1], a.values, b.values, zero);
    run_layer<kToneChannels, kToneChannels, kBlockOutputs>(layers[2], b.values, a.values, zero);
    run_layer<kToneChannels, 3, 3>(layers[3], a.values, phi.values, none);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#endif
