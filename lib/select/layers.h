// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "model/model_data.h"

namespace srisp {

/// weight · x + bias; sums in double.
std::vector<float> transformed(const DenseLayer& layer, const std::vector<float>& x);

/// max(v, 0) of each.
void rectify(std::vector<float>& values);

/// Adds the elements of `more` to those of `values`.
void add(std::vector<float>& values, const std::vector<float>& more);

/// The elements of `a`, then those of `b`.
std::vector<float> concatenated(std::vector<float> a, const std::vector<float>& b);

/// exp(x) / Σ exp(x), computed in double without overflow.
std::vector<float> softmax(const std::vector<float>& x);

/// A square image of interleaved channels with zeros above it and to its left, as a layer of an encoder reads it.
class EncoderInput {
public:
    /// `size`: even; all pixels have to be written.
    EncoderInput(int channels, int size);

    int channels() const { return m_channels; }
    int size() const { return m_size; }
    const float* data() const { return m_values.get(); } ///< the corner of the border
    std::ptrdiff_t row_stride() const { return m_row_stride; }
    /// Channel 0 of the first pixel of row y.
    float* row(int y) { return m_values.get() + (y + 1) * m_row_stride + m_channels; }

private:
    int m_channels, m_size;
    std::ptrdiff_t m_row_stride;
    std::unique_ptr<float[]> m_values;
};

/// Convolutions 3×3 with stride 2 and zero padding 1, ReLU on all but the last, then the mean over all pixels: one
/// feature per output channel of the last layer. [P 3.1]
std::vector<float> encode(const EncoderWeights& layers, EncoderInput input);

} // namespace srisp
