// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kernels/convolution.h"
#include "model/model_data.h"

namespace srisp {

/// weight · x + bias; sums in double.
std::vector<float> transformed(const DenseLayer& layer, const std::vector<float>& x);

/// The elements of `a`, then those of `b`.
std::vector<float> concatenated(std::vector<float> a, const std::vector<float>& b);

/// exp(x) / Σ exp(x), computed in double without overflow.
std::vector<float> softmax(const std::vector<float>& x);

/// Planes that go into a stride-2 convolution, with a border of zeros. Even and odd columns lie apart, so that the taps
/// of neighbouring outputs are neighbours in memory and `convolve_row` serves here too.
class StridedInput {
public:
    /// `size` × `size` pixels (even) in `channels` planes; set_row has to give all of them.
    StridedInput(int channels, int size);

    int channels() const { return m_channels; }
    int size() const { return m_size; }
    /// Copies one row of one channel.
    void set_row(int channel, int y, const float* values);
    /// Where tap (ky, kx) of a 3×3 kernel with stride 2 and padding 1 finds its input for output pixel 0 of row `y`.
    const float* tap(int y, int ky, int kx) const;
    std::ptrdiff_t plane_stride() const { return m_plane_stride; }

private:
    int m_channels, m_size;
    std::ptrdiff_t m_half_stride, m_row_stride, m_plane_stride;
    std::unique_ptr<float[]> m_values;
};

/// Convolutions 3×3 with stride 2 and zero padding 1, ReLU on all but the last, then the mean over all pixels: one
/// feature per output channel of the last layer. [P 3.1]
std::vector<float> encode(const EncoderWeights& layers, StridedInput input);

} // namespace srisp
