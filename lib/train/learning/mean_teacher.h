// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "train/learning/optimizer.h"
#include "train/network/unprocessor.h"
#include "train/tensors/torch_api.h"

namespace srisp::train {

/// Moves the moving average of vectors on by the `values` of step `step` (from 0): decay min(1 − 1/(step + 1), limit),
/// so that the first value counts in full and the first steps average evenly [P 3.3].
inline void average_into(torch::Tensor average, const torch::Tensor& values, std::int64_t step, double limit)
{
    const torch::NoGradGuard no_gradient;
    const double decay = std::min(1 - 1 / (static_cast<double>(step) + 1), limit);
    average.lerp_(values, 1 - decay);
}

/// PP_MT: pseudo pairs of photos without truth, which a slow copy of the model makes [P 3.3].
struct MeanTeacherSettings {
    double weight = 0.3;
    double start = 0.15;
    double decay = 0.999;
    std::string reference = "estimate";

    template<class Visitor> void describe(Visitor& v)
    {
        v.number("weight", weight, 0, 100, "of these pairs in the loss, alpha; 0: none are made");
        v.number("start", start, 0, 1, "after this share of the steps; the paper: 15 of 800 epochs");
        v.number("decay", decay, 0, 0.999999, "of the teacher's moving average, per step");
        v.choice("reference", reference, { "estimate", "raw" },
                 "what the student sees: the teacher's result itself, or the RAW image that the teacher saw");
    }
};

/// A model of the same kind as the one that learns, whose parameters are the moving average of that one's.
class AveragedModel {
public:
    AveragedModel(std::shared_ptr<Unprocessor> model, const torch::Tensor& start)
        : m_model(std::move(model)), m_parameters(*m_model)
    {
        m_parameters.values().copy_(start);
        m_model->eval();
    }

    Unprocessor& model() { return *m_model; }
    /// [P]
    torch::Tensor values() const { return m_parameters.values(); }

private:
    std::shared_ptr<Unprocessor> m_model;
    ParameterVector m_parameters;
};

} // namespace srisp::train
