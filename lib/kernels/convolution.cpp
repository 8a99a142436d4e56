// SPDX-License-Identifier: Apache-2.0
#include "kernels/convolution.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/convolution.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

#include "kernels/convolution_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
void convolve_row(const PackedConvolution& layer, const ConvolutionRow& row)
{
    convolve_blocks(layer, row);
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
            const float* w = layer.weights.data() +
                             std::ptrdiff_t(o / kWeightGroup * kWeightGroup) * layer.inputs * layer.taps +
                             o % kWeightGroup;
            float sum = layer.bias[o];
            for (int i = 0; i < layer.inputs; ++i)
                for (int t = 0; t < layer.taps; ++t, w += kWeightGroup)
                    sum = std::fma(*w, row.taps[t][i * row.in_plane_stride + x], sum);
            row.out[o * row.out_plane_stride + x] = row.relu ? std::max(sum, 0.0f) : sum;
        }
}

PackedConvolution pack_convolution(const ConvolutionWeights& weights)
{
    const int outputs = weights.outputs, inputs = weights.inputs, taps = weights.taps;
    PackedConvolution packed{ inputs, outputs, taps, {}, {} };
    const int padded = (outputs + kWidestBlock - 1) / kWidestBlock * kWidestBlock;
    packed.weights.assign(std::size_t(padded) * inputs * taps, 0.0f);
    packed.bias.assign(padded, 0.0f);
    std::copy(weights.bias.begin(), weights.bias.end(), packed.bias.begin());
    for (int o = 0; o < outputs; ++o)
        for (int it = 0; it < inputs * taps; ++it)
            packed.weights[(std::size_t(o / kWeightGroup) * inputs * taps + it) * kWeightGroup + o % kWeightGroup] =
                weights.weight[o * inputs * taps + it];
    return packed;
}

} // namespace srisp
#endif
