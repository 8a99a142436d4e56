// SPDX-License-Identifier: Apache-2.0
#include "kernels/strided_convolution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/strided_convolution.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace {

using D = hn::CappedTag<float, kEncoderGroup / 2>;
using V = hn::Vec<D>;

// Rows of an encoder are 64 to 2 pixels wide, but have 32 outputs at least: so vectors are outputs. 6 pixels × 2
// vectors hide the latency of an FMA, and with 2 weights and a pixel they fit 16 registers; 8 loads for 12 FMAs.
constexpr int kPixels = 6, kVectors = 2;

/// Outputs side by side of kPixels pixels. What a row of the kernel reads is side by side too: 3 pixels of all inputs.
HWY_INLINE void block(const EncoderLayer& layer, const StridedImages& images, const float* const (&in)[kPixels],
                      float* const (&out)[kPixels], int output)
{
    const D d;
    const int n = static_cast<int>(hn::Lanes(d));
    const float* HWY_RESTRICT weight = layer.weight.data() +
                                       std::ptrdiff_t(output / kEncoderGroup) * 9 * layer.inputs * kEncoderGroup +
                                       output % kEncoderGroup;
    V sums[kPixels][kVectors];
    for (int p = 0; p < kPixels; ++p)
        for (int k = 0; k < kVectors; ++k)
            sums[p][k] = hn::LoadU(d, layer.bias.data() + output + k * n);
    for (int row = 0; row < 3; ++row) {
        const std::ptrdiff_t offset = row * images.in_row_stride;
        for (std::ptrdiff_t i = offset; i < offset + 3 * layer.inputs; ++i, weight += kEncoderGroup) {
            V weights[kVectors];
            for (int k = 0; k < kVectors; ++k)
                weights[k] = hn::LoadU(d, weight + k * n);
            for (int p = 0; p < kPixels; ++p) {
                const V pixel = hn::Set(d, in[p][i]);
                for (int k = 0; k < kVectors; ++k)
                    sums[p][k] = hn::MulAdd(weights[k], pixel, sums[p][k]);
            }
        }
    }
    const V lowest = hn::Set(d, images.relu ? 0.0f : -std::numeric_limits<float>::infinity());
    for (int p = 0; p < kPixels; ++p)
        for (int k = 0; k < kVectors; ++k)
            hn::StoreU(hn::Max(sums[p][k], lowest), d, out[p] + output + k * n);
}

} // namespace

// Groups of outputs outside: their weights (147 KB for 128 inputs) stay in L2.
void strided_convolution(const EncoderLayer& layer, const StridedImages& images)
{
    const int step = kVectors * static_cast<int>(hn::Lanes(D()));
    const int count = images.size * images.size;
    for (int group = 0; group < layer.outputs; group += kEncoderGroup)
        for (int first = 0; first < count; first += kPixels) {
            const float* in[kPixels];
            float* out[kPixels];
            for (int p = 0; p < kPixels; ++p) { // the last pixel more than once, where they are no multiple
                const int pixel = std::min(first + p, count - 1), x = pixel % images.size, y = pixel / images.size;
                in[p] = images.in + 2 * (y * images.in_row_stride + std::ptrdiff_t(x) * layer.inputs);
                out[p] = images.out + y * images.out_row_stride + std::ptrdiff_t(x) * layer.outputs;
            }
            for (int output = group; output < group + kEncoderGroup; output += step)
                block(layer, images, in, out, output);
        }
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(strided_convolution);

void strided_convolution(const EncoderLayer& layer, const StridedImages& images)
{
    HWY_DYNAMIC_DISPATCH(strided_convolution)(layer, images);
}

void strided_convolution_scalar(const EncoderLayer& layer, const StridedImages& images)
{
    for (int y = 0; y < images.size; ++y)
        for (int x = 0; x < images.size; ++x)
            for (int o = 0; o < layer.outputs; ++o) {
                const float* weight = layer.weight.data() +
                                      std::ptrdiff_t(o / kEncoderGroup) * 9 * layer.inputs * kEncoderGroup +
                                      o % kEncoderGroup;
                const float* const in = images.in + 2 * (y * images.in_row_stride + std::ptrdiff_t(x) * layer.inputs);
                float sum = layer.bias[o];
                for (int row = 0; row < 3; ++row)
                    for (int i = 0; i < 3 * layer.inputs; ++i, weight += kEncoderGroup)
                        sum = std::fma(*weight, in[row * images.in_row_stride + i], sum);
                images.out[y * images.out_row_stride + std::ptrdiff_t(x) * layer.outputs + o] =
                    images.relu ? std::max(sum, 0.0f) : sum;
            }
}

} // namespace srisp
#endif
