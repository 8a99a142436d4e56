// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "train/learning/checkpoint.h"
#include "train/learning/losses.h"
#include "train/learning/mean_teacher.h"
#include "train/learning/optimizer.h"
#include "train/learning/process_group.h"
#include "train/network/unprocessor.h"
#include "train/samples/samples.h"

namespace srisp::train {

/// How a model learns, whatever it is and whatever from.
struct TrainerSettings {
    int steps = 2400;
    int pairs = 24, unpaired = 12;
    double average_decay = 0.995;
    double dictionary_augmentation = 0;
    LossSettings loss;
    MeanTeacherSettings mean_teacher;
    OptimizerSettings optimizer;

    template<class Visitor> void describe(Visitor& v)
    {
        v.integer("steps", steps, 1, 100'000'000, "optimiser steps; the schedules are stretched over them");
        v.integer("pairs", pairs, 1, 100'000, "pseudo pairs per step, of all processes together");
        v.integer("unpaired", unpaired, 0, 100'000, "photos without truth per step, likewise");
        v.number("average_decay", average_decay, 0, 0.999999,
                 "of the moving average of the weights, per step: the model that is tested and saved");
        v.number("dictionary_augmentation", dictionary_augmentation, 0, 1,
                 "share of pseudo pairs whose photo the model renders itself, by random mixes of its atoms");
        v.group("loss", loss);
        v.group("mean_teacher", mean_teacher);
        v.group("optimizer", optimizer);
    }

    /// The first step that needs photos without truth; beyond the last where none does.
    std::int64_t first_taught_step() const;
};

/// What one step did. Values are means over the batches of all processes.
struct StepReport {
    double loss = 0;
    std::vector<std::pair<std::string, double>> terms; ///< of the pseudo pairs, without their weights
    double gradient_norm = 0;
    bool finite = true; ///< false: loss or gradient were not numbers, nothing was learnt, the state is as before
    bool stop = false;  ///< some process was asked to stop
    double data_seconds = 0, learning_seconds = 0, other_seconds = 0;
};

/// Trains one model, step by step. Every process of a group has a trainer and makes the same calls.
class Trainer {
public:
    using Factory = std::function<std::shared_ptr<Unprocessor>()>;

    /// `model` is what learns; `make` gives others of its kind, whose parameters do not matter. All are on `device`.
    Trainer(const TrainerSettings& settings, std::shared_ptr<Unprocessor> model, const Factory& make,
            std::shared_ptr<Samples> samples, ProcessGroup& group, torch::Device device, std::uint64_t seed = 0);

    /// `stop`: this process was asked to stop; all processes learn of it in the same step. Errors: the ProcessGroup's.
    Expected<StepReport> step(bool stop = false);

    std::int64_t steps_done() const { return m_steps_done; }
    bool finished() const { return m_steps_done >= m_settings.steps; }
    std::int64_t parameter_count() const { return m_parameters.values().numel(); }
    /// The moving average, which is what is tested and saved.
    Unprocessor& averaged_model() { return m_averaged.model(); }
    /// Factor of the learning rate at a step.
    double rate_factor_of(std::int64_t step) const { return rate_factor(m_settings.optimizer, step, m_settings.steps); }
    /// Whether all weights are finite numbers.
    bool sound() const;

    /// State as it is (not a copy), for save_checkpoint.
    TrainingState state() const;
    /// Goes on from a state. Errors: of another model.
    Status restore(const TrainingState& state);
    /// All processes take over the state of rank 0.
    Status share_state();

private:
    struct Pass;
    Batch next_batch();
    Pass learn(const Batch& batch);
    void add_teacher_pairs(Batch& batch);
    std::vector<std::pair<std::string, torch::Tensor>> vectors() const;

    TrainerSettings m_settings;
    ProcessGroup& m_group;
    torch::Device m_device;
    std::uint64_t m_seed;
    SampleSlice m_slice;
    SampleQueue m_samples;
    std::shared_ptr<Unprocessor> m_student;
    ParameterVector m_parameters;
    AveragedModel m_teacher, m_averaged;
    Adam m_adam;
    std::int64_t m_steps_done = 0;
};

} // namespace srisp::train
