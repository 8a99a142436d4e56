// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "torch_api.h"

namespace srisp::train {

/// Where learning starts; normal numbers from a generator that the model's seed set.
class InitialWeights {
public:
    explicit InitialWeights(std::uint64_t seed) : m_generator(at::detail::createCPUGenerator(seed)) {}

    torch::Tensor normal(torch::IntArrayRef shape, double deviation)
    {
        return torch::empty(shape).normal_(0, deviation, m_generator);
    }

    /// For a layer [O, I, …] that a ReLU follows (He et al. 2015).
    torch::Tensor he(torch::IntArrayRef shape) { return normal(shape, std::sqrt(2.0 / inputs(shape))); }

    /// For an affine layer: the variance of LibTorch's own default.
    torch::Tensor affine(torch::IntArrayRef shape) { return normal(shape, std::sqrt(1 / (3.0 * inputs(shape)))); }

private:
    static double inputs(torch::IntArrayRef shape)
    {
        double count = 1;
        for (std::size_t i = 1; i < shape.size(); ++i)
            count *= static_cast<double>(shape[i]);
        return count;
    }

    at::Generator m_generator;
};

} // namespace srisp::train
