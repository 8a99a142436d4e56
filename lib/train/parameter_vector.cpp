// SPDX-License-Identifier: Apache-2.0
#include "parameter_vector.h"

#include "model/safetensors.h"

namespace srisp::train {

ParameterVector::ParameterVector(torch::nn::Module& module)
{
    const torch::NoGradGuard no_gradient;
    std::vector<torch::Tensor> pieces;
    std::int64_t offset = 0;
    for (const auto& item : module.named_parameters()) {
        m_parts.push_back({ item.value(), offset });
        pieces.push_back(item.value().detach().reshape({ -1 }));
        offset += item.value().numel();
        m_layout += (m_layout.empty() ? "" : " ") + item.key() + shape_text(item.value().sizes().vec());
    }
    m_values = pieces.empty() ? torch::zeros({ 0 }) : torch::cat(pieces);
    m_gradients = torch::zeros_like(m_values);
    for (Part& part : m_parts) {
        const auto view = [&part](const torch::Tensor& vector) {
            return vector.narrow(0, part.offset, part.parameter.numel()).view(part.parameter.sizes());
        };
        part.parameter.set_data(view(m_values));
        part.parameter.mutable_grad() = view(m_gradients);
    }
}

torch::Tensor ParameterVector::mask_of(const std::vector<torch::Tensor>& chosen) const
{
    torch::Tensor mask = torch::zeros_like(m_values);
    for (const Part& part : m_parts)
        for (const torch::Tensor& parameter : chosen)
            if (parameter.is_same(part.parameter))
                mask.narrow(0, part.offset, parameter.numel()).fill_(1);
    return mask;
}

std::vector<torch::Tensor> weights_of(const torch::nn::Module& module)
{
    std::vector<torch::Tensor> weights;
    for (const torch::Tensor& parameter : module.parameters())
        if (parameter.dim() >= 2)
            weights.push_back(parameter);
    return weights;
}

} // namespace srisp::train
