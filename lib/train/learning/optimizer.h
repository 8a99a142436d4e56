// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "train/tensors/torch_api.h"

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

struct OptimizerSettings {
    double rate = 1e-3;
    double dictionary_rate = 6e-3;
    std::string schedule = "one_cycle";
    double warm_up = 0.1;
    double final_factor = 1e-3;
    double clip_norm = 1;
    double beta1 = 0.9, beta2 = 0.999;
    double weight_decay = 0;

    template<class Visitor> void describe(Visitor& v)
    {
        v.number("rate", rate, 0, 1, "learning rate of Adam at its highest");
        v.number("dictionary_rate", dictionary_rate, 0, 1, "the same for the dictionaries' atoms");
        v.choice("schedule", schedule, { "one_cycle", "cosine", "step", "constant" },
                 "course of the rate; step: a tenth after 250/800 and 500/800 of the steps, as in the paper");
        v.number("warm_up", warm_up, 0, 0.9, "one_cycle: share of the steps in which the rate rises");
        v.number("final_factor", final_factor, 0, 1, "one_cycle, cosine: the last rate, as a share of the highest");
        v.number("clip_norm", clip_norm, 1e-6, 1e6, "largest norm of the gradient; what is longer is shortened");
        v.number("beta1", beta1, 0, 0.9999, "Adam: memory of the gradient");
        v.number("beta2", beta2, 0, 0.99999, "Adam: memory of its square");
        v.number("weight_decay", weight_decay, 0, 1, "decoupled weight decay; dictionaries and biases have none");
    }
};

/// Factor of the learning rate at `step` of `steps`: 1 at its highest.
double rate_factor(const OptimizerSettings& settings, std::int64_t step, std::int64_t steps);

/// Adam (Kingma and Ba 2015) with decoupled weight decay, on all parameters at once, behind a limit on the gradient's
/// norm.
class Adam {
public:
    /// `dictionaries` [P]: 1 for elements that learn at their rate; `decayed` [P]: 1 for those of the others that
    /// decay.
    Adam(const OptimizerSettings& settings, const ParameterVector& parameters, const torch::Tensor& dictionaries,
         const torch::Tensor& decayed);

    /// The norm of the gradient, before it is limited.
    double gradient_norm() const;

    /// Update number `step` (from 0) with a gradient of norm `norm`; `factor` from rate_factor.
    void update(std::int64_t step, double factor, double norm);

    /// The moments [P], for checkpoints.
    torch::Tensor first_moment, second_moment;

private:
    OptimizerSettings m_settings;
    torch::Tensor m_values, m_gradients, m_rates, m_decays;
};

} // namespace srisp::train
