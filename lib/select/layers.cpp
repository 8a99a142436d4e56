// SPDX-License-Identifier: Apache-2.0
#include "select/layers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace srisp {

std::vector<float> transformed(const DenseLayer& layer, const std::vector<float>& x)
{
    std::vector<float> y(layer.bias);
    for (int o = 0; o < layer.outputs; ++o) {
        double sum = layer.bias[o];
        for (int i = 0; i < layer.inputs; ++i)
            sum += static_cast<double>(layer.weight[o * layer.inputs + i]) * x[i];
        y[o] = static_cast<float>(sum);
    }
    return y;
}

std::vector<float> concatenated(std::vector<float> a, const std::vector<float>& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::vector<float> softmax(const std::vector<float>& x)
{
    const float largest = *std::max_element(x.begin(), x.end());
    std::vector<double> terms;
    double sum = 0;
    for (const float v : x)
        sum += terms.emplace_back(std::exp(static_cast<double>(v) - largest));
    std::vector<float> weights;
    for (const double term : terms)
        weights.push_back(static_cast<float>(term / sum));
    return weights;
}

// A row is stored as [0, column 1, column 3, …][column 0, column 2, …]; output x needs columns 2x − 1, 2x, 2x + 1,
// which are elements x of the first part, x of the second and x + 1 of the first. Row −1 is stored, and zero; no row
// below is needed. What a kernel reads past the end of a row is the next one. Only what set_row does not write is set
// here: zeroing megabytes takes as long as a layer.
StridedInput::StridedInput(int channels, int size)
    : m_channels(channels), m_size(size), m_half_stride(size / 2 + 1), m_row_stride(2 * m_half_stride),
      m_plane_stride(m_row_stride * (size + 1)), m_values(new float[m_plane_stride * channels + kRowSlack])
{
    for (int channel = 0; channel < channels; ++channel) {
        float* const plane = m_values.get() + channel * m_plane_stride;
        std::fill_n(plane, m_row_stride, 0.0f);
        for (int y = 0; y < size; ++y) {
            float* const row = plane + (y + 1) * m_row_stride;
            row[0] = row[m_row_stride - 1] = 0;
        }
    }
    std::fill_n(m_values.get() + m_plane_stride * channels, kRowSlack, 0.0f);
}

void StridedInput::set_row(int channel, int y, const float* values)
{
    float* odd = m_values.get() + channel * m_plane_stride + (y + 1) * m_row_stride + 1;
    float* even = odd - 1 + m_half_stride;
    for (int x = 0; x < m_size / 2; ++x) {
        even[x] = values[2 * x];
        odd[x] = values[2 * x + 1];
    }
}

const float* StridedInput::tap(int y, int ky, int kx) const
{
    const float* row = m_values.get() + (2 * y + ky) * m_row_stride; // row 2y − 1 + ky, row −1 being the first
    return kx == 1 ? row + m_half_stride : row + kx / 2;
}

/// Calls `take(channel, y, row)` for every row of a layer's output.
template<class Take>
static void convolve(const ConvolutionWeights& weights, const StridedInput& input, bool relu, Take take)
{
    const PackedConvolution layer = pack_convolution(weights);
    const int size = input.size() / 2;
    const std::ptrdiff_t stride = size + kRowSlack;
    std::vector<float> out(stride * weights.outputs);
    for (int y = 0; y < size; ++y) {
        ConvolutionRow row{ {}, input.plane_stride(), out.data(), stride, size, relu };
        for (int t = 0; t < 9; ++t)
            row.taps[t] = input.tap(y, t / 3, t % 3);
        convolve_row(layer, row);
        for (int channel = 0; channel < weights.outputs; ++channel)
            take(channel, y, out.data() + channel * stride);
    }
}

std::vector<float> encode(const EncoderWeights& layers, StridedInput input)
{
    for (std::size_t l = 0; l + 1 < layers.size(); ++l) {
        StridedInput next(layers[l].outputs, input.size() / 2);
        convolve(layers[l], input, true, [&](int channel, int y, const float* row) { next.set_row(channel, y, row); });
        input = std::move(next);
    }
    const int size = input.size() / 2;
    std::vector<double> sums(layers.back().outputs);
    convolve(layers.back(), input, false, [&](int channel, int, const float* row) {
        sums[channel] = std::accumulate(row, row + size, sums[channel]);
    });
    std::vector<float> features;
    for (const double sum : sums)
        features.push_back(static_cast<float>(sum / (size * size)));
    return features;
}

} // namespace srisp
