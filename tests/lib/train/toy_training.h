// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>

#include "train/learning/trainer.h"

/// A model that is learnt in a few steps: a gain and a matrix, of which the gain depends on the reference's mean.
class ToyModel : public srisp::train::Unprocessor {
public:
    ToyModel()
    {
        m_gain = register_parameter("gain", torch::full({ 1 }, 0.7));
        m_matrix = register_parameter("matrix", torch::eye(3) * 0.8 + 0.1);
        m_bias = register_parameter("bias", torch::zeros({ 3 }));
    }

    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          srisp::train::ChosenParameters* choice = nullptr) override
    {
        srisp::train::ChosenParameters own;
        srisp::train::ChosenParameters& chosen = choice ? *choice : own;
        chosen.gain = m_gain * (reference.mean({ 1, 2, 3 }) + 0.5);
        return apply_reverse(source, chosen);
    }
    torch::Tensor apply_reverse(const torch::Tensor& image, const srisp::train::ChosenParameters& choice) override
    {
        return (torch::einsum("oc,nchw->nohw", { m_matrix, image }) + m_bias.view({ 1, 3, 1, 1 })) *
               choice.gain.view({ -1, 1, 1, 1 });
    }
    torch::Tensor process(const torch::Tensor& raw, const srisp::train::ChosenParameters& choice) override
    {
        return raw / choice.gain.view({ -1, 1, 1, 1 });
    }
    std::vector<torch::Tensor> dictionary_parameters() override { return { m_gain }; }
    void constrain() override
    {
        const torch::NoGradGuard no_gradient;
        m_gain.clamp_min_(1e-3);
    }

    torch::Tensor m_gain, m_matrix, m_bias;
};

/// Random images whose truth is the source times a gain from the reference; sample i of a step is always the same.
class ToySamples : public srisp::train::Samples {
public:
    /// From step `broken_from` on, one pixel of the truth is `broken`. `size`: width and height.
    explicit ToySamples(std::int64_t broken_from = -1, float broken = NAN, int size = 8)
        : m_broken_from(broken_from), m_broken(broken), m_size(size)
    {
    }

    srisp::train::Batch batch(std::int64_t step, int first_pair, int pairs, int first_unpaired, int unpaired) override
    {
        srisp::train::Batch batch;
        batch.source = images(step, first_pair, pairs, 1);
        batch.reference = images(step, first_pair, pairs, 2);
        batch.truth = batch.source * (batch.reference.mean({ 1, 2, 3 }, true) + 0.5) * 0.5;
        if (m_broken_from >= 0 && step >= m_broken_from)
            batch.truth[0][0][0][0] = m_broken;
        if (unpaired > 0) {
            batch.unpaired_source = images(step, first_unpaired, unpaired, 3);
            batch.unpaired_reference = images(step, first_unpaired, unpaired, 4);
        }
        return batch;
    }

private:
    torch::Tensor images(std::int64_t step, int first, int count, int kind) const
    {
        std::vector<torch::Tensor> list;
        for (int i = first; i < first + count; ++i) {
            torch::Generator generator =
                torch::make_generator<torch::CPUGeneratorImpl>(static_cast<std::uint64_t>(step * 1000 + i * 10 + kind));
            list.push_back(torch::rand({ 3, m_size, m_size }, generator));
        }
        return torch::stack(list);
    }

    std::int64_t m_broken_from;
    float m_broken;
    int m_size;
};

inline srisp::train::TrainerSettings toy_settings(int steps = 12)
{
    srisp::train::TrainerSettings settings;
    settings.steps = steps;
    settings.pairs = 6;
    settings.unpaired = 4;
    settings.optimizer.rate = 0.02;
    settings.optimizer.dictionary_rate = 0.05;
    settings.mean_teacher.start = 0.25;
    return settings;
}

inline srisp::train::Trainer
toy_trainer(const srisp::train::TrainerSettings& settings, srisp::train::ProcessGroup& group,
            std::shared_ptr<srisp::train::Samples> samples = std::make_shared<ToySamples>())
{
    const auto make = [] { return std::make_shared<ToyModel>(); };
    return srisp::train::Trainer(settings, make(), make, std::move(samples), group, torch::kCPU);
}
