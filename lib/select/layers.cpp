// SPDX-License-Identifier: Apache-2.0
#include "select/layers.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "features/sums.h"
#include "kernels/strided_convolution.h"

namespace srisp {

std::vector<float> transformed(const DenseLayer& layer, const std::vector<float>& x)
{
    std::vector<float> y(layer.bias);
    for (int o = 0; o < layer.outputs; ++o)
        y[o] = static_cast<float>(
            layer.bias[o] + product_of(layer.weight.data() + std::ptrdiff_t(o) * layer.inputs, x.data(), layer.inputs));
    return y;
}

void rectify(std::vector<float>& values)
{
    for (float& value : values)
        value = std::max(value, 0.0f);
}

void add(std::vector<float>& values, const std::vector<float>& more)
{
    std::transform(values.begin(), values.end(), more.begin(), values.begin(), std::plus<float>());
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

EncoderInput::EncoderInput(int channels, int size)
    : m_channels(channels), m_size(size), m_row_stride(std::ptrdiff_t(size + 1) * channels),
      m_values(new float[m_row_stride * (size + 1)])
{
    std::fill_n(m_values.get(), m_row_stride, 0.0f);
    for (int y = 0; y < size; ++y)
        std::fill_n(row(y) - channels, channels, 0.0f);
}

std::vector<float> encode(const EncoderWeights& layers, EncoderInput input)
{
    for (std::size_t l = 0; l + 1 < layers.size(); ++l) {
        EncoderInput next(layers[l].outputs, input.size() / 2);
        strided_convolution(layers[l],
                            { input.data(), input.row_stride(), next.row(0), next.row_stride(), next.size(), true });
        input = std::move(next);
    }
    const int size = input.size() / 2, pixels = size * size, outputs = layers.back().outputs;
    std::vector<float> out(std::size_t(pixels) * outputs);
    strided_convolution(layers.back(),
                        { input.data(), input.row_stride(), out.data(), std::ptrdiff_t(size) * outputs, size, false });
    std::vector<float> features;
    for (int o = 0; o < outputs; ++o) {
        double sum = 0;
        for (int i = 0; i < pixels; ++i)
            sum += out[std::size_t(i) * outputs + o];
        features.push_back(static_cast<float>(sum / pixels));
    }
    return features;
}

} // namespace srisp
