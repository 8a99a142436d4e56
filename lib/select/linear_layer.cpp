// SPDX-License-Identifier: Apache-2.0
#include "select/linear_layer.h"

#include <algorithm>
#include <cmath>

namespace srisp {

std::vector<float> transformed(const Linear& layer, const std::vector<float>& x)
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

} // namespace srisp
