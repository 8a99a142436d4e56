// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "torch_api.h"

namespace srisp::train {

/// All parameters of a module as one vector: each parameter, and its gradient, becomes a view of it. So optimising,
/// averaging, saving and sending to other machines are one operation each. The module must not move to another device,
/// nor replace its parameters, afterwards.
class ParameterVector {
public:
    explicit ParameterVector(torch::nn::Module& module);

    /// [P]; writing to it changes the module.
    torch::Tensor values() const { return m_values; }
    /// [P]; what backward() adds to. Set it to zero before each step.
    torch::Tensor gradients() const { return m_gradients; }
    /// Names and shapes in order, as one line: two modules with the same layout can exchange vectors.
    const std::string& layout() const { return m_layout; }
    /// [P]: 1 where an element belongs to one of `chosen`, else 0.
    torch::Tensor mask_of(const std::vector<torch::Tensor>& chosen) const;

private:
    struct Part {
        torch::Tensor parameter;
        std::int64_t offset;
    };
    std::vector<Part> m_parts;
    torch::Tensor m_values, m_gradients;
    std::string m_layout;
};

/// The parameters of a module that are matrices or convolutions: these decay; biases and single numbers do not.
std::vector<torch::Tensor> weights_of(const torch::nn::Module& module);

} // namespace srisp::train
