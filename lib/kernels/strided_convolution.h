// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "model/model_data.h"

namespace srisp {

/// Square images of interleaved channels: what a layer of an encoder reads and what it writes.
struct StridedImages {
    const float* in; ///< (2 · size + 1)² pixels, of which the first row and the first column are zeros
    std::ptrdiff_t in_row_stride;
    float* out; ///< size² pixels
    std::ptrdiff_t out_row_stride;
    int size;
    bool relu;
};

/// out(x, y)[o] = bias[o] + Σ weight[o][ky][kx][i] · in(2x + kx, 2y + ky)[i], then max(0, ·) where `relu`: a 3×3
/// cross-correlation with stride 2 and a border of zeros. The sums run over ky, kx, i, so each pixel gets the same bits
/// wherever it lies. Vectorised over outputs, dispatched at run time.
void strided_convolution(const EncoderLayer& layer, const StridedImages& images);

/// The same in plain C++: what the vectorised form is tested against.
void strided_convolution_scalar(const EncoderLayer& layer, const StridedImages& images);

} // namespace srisp
