// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kernels/convolution.h"

namespace srisp {

// Convolutions by the dot products of AVX-512 BF16, which multiply two pairs of bf16 numbers (float32 cut to 8 bits of
// mantissa) and add both products to a float32 sum: twice the multiply-adds per instruction. Channels travel in pairs:
// a float's place in a plane, and in the weights, holds two bf16, the even channel's in the lower half.

/// Whether this processor has them, and nobody has told Highway to do without AVX-512.
bool has_bf16();

/// Weights for inputs in pairs: `inputs` of the result is half of what it was. Even numbers of inputs only.
PackedConvolution pack_bf16(const ConvolutionWeights& weights);

/// As convolve_row; the names say what is read, then what is written. Layers that write pairs have an even number of
/// outputs. Each pixel gets the same bits wherever it lies in the row. Only where has_bf16().
void convolve_floats_to_pairs(const PackedConvolution& layer, const ConvolutionRow& row);
void convolve_pairs_to_pairs(const PackedConvolution& layer, const ConvolutionRow& row);
void convolve_pairs_to_floats(const PackedConvolution& layer, const ConvolutionRow& row);

/// Two floats, rounded to nearest even, in the place of one; and back. What the kernels are tested with.
float bf16_pair(float even, float odd);
float even_of_pair(float pair);
float odd_of_pair(float pair);

} // namespace srisp
