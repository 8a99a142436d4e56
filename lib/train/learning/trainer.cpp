// SPDX-License-Identifier: Apache-2.0
#include "train/learning/trainer.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "train/learning/dictionary_augmentation.h"

namespace srisp::train {

namespace {

class Stopwatch {
public:
    /// Seconds since the last call.
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - m_last).count();
        m_last = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

SampleSlice slice_of(const TrainerSettings& settings, const ProcessGroup& group)
{
    const auto first = [&group](int total, int rank) {
        return static_cast<int>(static_cast<std::int64_t>(total) * rank / group.size());
    };
    const int rank = group.rank(), pair = first(settings.pairs, rank), photo = first(settings.unpaired, rank);
    return { pair, first(settings.pairs, rank + 1) - pair, photo, first(settings.unpaired, rank + 1) - photo,
             settings.first_taught_step() };
}

torch::Tensor joined(const torch::Tensor& first, const torch::Tensor& second)
{
    return second.defined() ? torch::cat({ first, second }) : first;
}

} // namespace

std::int64_t TrainerSettings::first_taught_step() const
{
    if (mean_teacher.weight == 0 || unpaired == 0)
        return std::numeric_limits<std::int64_t>::max();
    return static_cast<std::int64_t>(std::ceil(mean_teacher.start * steps));
}

/// Sums over this process's part of the batches, such that the sum over processes is the mean over the batches.
struct Trainer::Pass {
    torch::Tensor loss;
    std::vector<std::string> names;
    std::vector<torch::Tensor> values; ///< of the names
};

Trainer::Trainer(const TrainerSettings& settings, std::shared_ptr<Unprocessor> model, const Factory& make,
                 std::shared_ptr<Samples> samples, ProcessGroup& group, torch::Device device, std::uint64_t seed)
    : m_settings(settings), m_group(group), m_device(device), m_seed(seed), m_slice(slice_of(settings, group)),
      m_samples(std::move(samples), m_slice, device.is_cuda()), m_student(std::move(model)), m_parameters(*m_student),
      m_teacher(make(), m_parameters.values()), m_averaged(make(), m_parameters.values()),
      m_adam(settings.optimizer, m_parameters, m_parameters.mask_of(m_student->dictionary_parameters()),
             m_parameters.mask_of(weights_of(*m_student)) * (1 - m_parameters.mask_of(m_student->anchor_parameters())))
{
    m_student->train();
}

Batch Trainer::next_batch()
{
    Batch batch = m_samples.batch(m_steps_done);
    for (torch::Tensor* images :
         { &batch.source, &batch.truth, &batch.reference, &batch.unpaired_source, &batch.unpaired_reference })
        if (images->defined())
            *images = images->to(m_device);
    if (m_settings.dictionary_augmentation > 0)
        batch.source =
            augment_by_dictionaries(m_teacher.model(), batch.source, batch.truth, batch.reference,
                                    m_settings.dictionary_augmentation, m_seed, m_steps_done, m_slice.first_pair);
    return batch;
}

/// Appends the teacher's pairs: PP_MT, where the student's reference is what the teacher made of the photo [P 3.3].
void Trainer::add_teacher_pairs(Batch& batch)
{
    if (!batch.unpaired_source.defined() || batch.unpaired_source.size(0) == 0)
        return;
    torch::Tensor estimate;
    {
        const torch::NoGradGuard no_gradient;
        estimate = m_teacher.model().reverse(batch.unpaired_source, batch.unpaired_reference).clamp(0, 1);
    }
    batch.source = joined(batch.source, batch.unpaired_source);
    batch.truth = joined(batch.truth, estimate);
    batch.reference =
        joined(batch.reference, m_settings.mean_teacher.reference == "estimate" ? estimate : batch.unpaired_reference);
}

Trainer::Pass Trainer::learn(const Batch& batch)
{
    ChosenParameters choice;
    Compared images;
    images.source = batch.source;
    images.truth = batch.truth;
    images.predicted = m_student->reverse(batch.source, batch.reference, &choice);
    images.expected_means = choice.expected_means;
    if (m_settings.loss.forward > 0) {
        torch::Tensor shown = batch.truth;
        if (m_settings.loss.brightness_matched) // the truth, as bright as the model takes it to be
            shown = (shown * brightness_ratio(images.predicted, shown)).clamp_max(1);
        images.processed = m_student->process(shown, choice);
    }
    if (needs_round_trip(m_settings.loss))
        images.round_trip = m_student->process(images.predicted, choice);

    const std::int64_t taught = batch.unpaired_source.defined() ? batch.unpaired_source.size(0) : 0;
    const std::int64_t pairs = batch.source.size(0) - taught;
    Pass pass;
    torch::Tensor of_pairs, of_teacher;
    for (const LossTerm& term : loss_terms(m_settings.loss, images)) {
        const torch::Tensor mean = term.values.narrow(0, 0, pairs).sum() / m_settings.pairs;
        pass.names.push_back(term.name);
        pass.values.push_back(mean.detach());
        of_pairs = of_pairs.defined() ? of_pairs + term.weight * mean : term.weight * mean;
        if (taught > 0) {
            const torch::Tensor value = term.weight * term.values.narrow(0, pairs, taught).sum() / m_settings.unpaired;
            of_teacher = of_teacher.defined() ? of_teacher + value : value;
        }
    }
    pass.loss = of_pairs;
    if (taught > 0) {
        pass.loss = pass.loss + m_settings.mean_teacher.weight * of_teacher;
        pass.names.push_back("teacher");
        pass.values.push_back(of_teacher.detach());
    }
    m_parameters.gradients().zero_();
    pass.loss.backward();
    return pass;
}

Expected<StepReport> Trainer::step(bool stop)
{
    StepReport report;
    Stopwatch watch;
    Batch batch = next_batch();
    report.data_seconds = watch.lap();

    add_teacher_pairs(batch);
    const Pass pass = learn(batch);
    // One vector for all that the processes have to know of each other.
    std::vector<torch::Tensor> numbers = pass.values;
    numbers.push_back(pass.loss.detach());
    torch::Tensor sums = torch::stack(numbers).cpu();
    sums = torch::cat({ sums, torch::full({ 1 }, stop ? 1.0 : 0.0) });
    report.learning_seconds = watch.lap();

    if (Status status = m_group.sum(m_parameters.gradients()); !status)
        return status.error();
    if (Status status = m_group.sum(sums); !status)
        return status.error();
    for (std::size_t i = 0; i < pass.names.size(); ++i)
        report.terms.emplace_back(pass.names[i], sums[static_cast<std::int64_t>(i)].item<double>());
    report.loss = sums[-2].item<double>();
    report.stop = sums[-1].item<double>() > 0;
    report.gradient_norm = m_adam.gradient_norm();
    report.finite = std::isfinite(report.loss) && std::isfinite(report.gradient_norm);
    if (report.finite) {
        m_adam.update(m_steps_done, rate_factor_of(m_steps_done), report.gradient_norm);
        m_student->constrain();
        average_into(m_teacher.values(), m_parameters.values(), m_steps_done, m_settings.mean_teacher.decay);
        average_into(m_averaged.values(), m_parameters.values(), m_steps_done, m_settings.average_decay);
        ++m_steps_done;
    }
    report.other_seconds = watch.lap();
    return report;
}

bool Trainer::sound() const
{
    return m_parameters.values().isfinite().all().item<bool>();
}

std::vector<std::pair<std::string, torch::Tensor>> Trainer::vectors() const
{
    return { { "weights", m_parameters.values() },
             { "teacher", m_teacher.values() },
             { "average", m_averaged.values() },
             { "first_moment", m_adam.first_moment },
             { "second_moment", m_adam.second_moment } };
}

TrainingState Trainer::state() const
{
    TrainingState state;
    for (const auto& [name, vector] : vectors())
        state.tensors[name] = vector;
    state.numbers["step"] = static_cast<double>(m_steps_done);
    state.layout = m_parameters.layout();
    return state;
}

Status Trainer::restore(const TrainingState& state)
{
    if (state.layout != m_parameters.layout())
        return Error{ "is of a model with other tensors: has " + state.layout + ", needs " + m_parameters.layout() };
    if (state.numbers.count("step") == 0)
        return Error{ "has no 'step'" };
    for (const auto& [name, vector] : vectors()) {
        const auto found = state.tensors.find(name);
        if (found == state.tensors.end() || found->second.sizes() != vector.sizes())
            return Error{ "has no '" + name + "' of " + std::to_string(vector.numel()) + " numbers" };
        vector.copy_(found->second);
    }
    m_steps_done = static_cast<std::int64_t>(state.numbers.at("step"));
    return {};
}

Status Trainer::share_state()
{
    for (const auto& item : vectors())
        if (Status status = m_group.broadcast(item.second); !status)
            return status;
    torch::Tensor step = torch::full({ 1 }, static_cast<double>(m_steps_done), torch::kDouble);
    if (Status status = m_group.broadcast(step); !status)
        return status;
    m_steps_done = static_cast<std::int64_t>(step.item<double>());
    return {};
}

} // namespace srisp::train
