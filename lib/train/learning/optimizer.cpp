// SPDX-License-Identifier: Apache-2.0
#include "train/learning/optimizer.h"

#include <cmath>

#include "model/safetensors.h"

namespace srisp::train {

namespace {

constexpr double kFirstFactor = 1.0 / 25; // one_cycle begins at a 25th of the highest rate (Smith and Topin 2018)

/// Half a cosine from `from` to `to` while `x` goes from 0 to 1.
double half_cosine(double from, double to, double x)
{
    return to + (from - to) * (1 + std::cos(M_PI * x)) / 2;
}

} // namespace

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

double rate_factor(const OptimizerSettings& settings, std::int64_t step, std::int64_t steps)
{
    const double done = static_cast<double>(step) / static_cast<double>(steps);
    if (settings.schedule == "cosine")
        return half_cosine(1, settings.final_factor, done);
    if (settings.schedule == "one_cycle")
        return done < settings.warm_up
                   ? half_cosine(kFirstFactor, 1, done / settings.warm_up)
                   : half_cosine(1, settings.final_factor, (done - settings.warm_up) / (1 - settings.warm_up));
    if (settings.schedule == "step") // [P A.2]: epochs 250 and 500 of 800
        return done < 250.0 / 800 ? 1 : done < 500.0 / 800 ? 0.1 : 0.01;
    return 1;
}

Adam::Adam(const OptimizerSettings& settings, const ParameterVector& parameters, const torch::Tensor& dictionaries,
           const torch::Tensor& decayed)
    : first_moment(torch::zeros_like(parameters.values())), second_moment(torch::zeros_like(parameters.values())),
      m_settings(settings), m_values(parameters.values()), m_gradients(parameters.gradients()),
      m_rates(dictionaries * (settings.dictionary_rate - settings.rate) + settings.rate),
      m_decays(decayed * (1 - dictionaries) * settings.rate * settings.weight_decay)
{
}

double Adam::gradient_norm() const
{
    return m_gradients.norm().item<double>();
}

void Adam::update(std::int64_t step, double factor, double norm)
{
    const torch::NoGradGuard no_gradient;
    if (norm > m_settings.clip_norm)
        m_gradients.mul_(m_settings.clip_norm / norm);
    first_moment.mul_(m_settings.beta1).add_(m_gradients, 1 - m_settings.beta1);
    second_moment.mul_(m_settings.beta2).addcmul_(m_gradients, m_gradients, 1 - m_settings.beta2);
    const double count = static_cast<double>(step) + 1;
    const double correction1 = 1 - std::pow(m_settings.beta1, count);
    const double correction2 = 1 - std::pow(m_settings.beta2, count);
    if (m_settings.weight_decay > 0)
        m_values.addcmul_(m_values, m_decays, -factor);
    const torch::Tensor root = second_moment.div(correction2).sqrt_().add_(1e-8);
    m_values.addcdiv_(first_moment * m_rates, root, -factor / correction1);
}

} // namespace srisp::train
