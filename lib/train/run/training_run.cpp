// SPDX-License-Identifier: Apache-2.0
#include "train/run/training_run.h"

#include <algorithm>
#include <cmath>

namespace srisp::train {

namespace {

constexpr double kLossMemory = 0.98; // of the smoothed loss, per step
constexpr double kRetrySeconds = 60; // after a checkpoint that could not be written
constexpr double kNoScore = -1e300;

} // namespace

TrainingRun::TrainingRun(Trainer& trainer, ProcessGroup& group, const RunSettings& settings, std::int64_t steps,
                         std::map<std::string, std::string> origin, std::string folder, RunHost& host)
    : m_trainer(trainer), m_group(group), m_settings(settings), m_steps(steps), m_origin(std::move(origin)),
      m_folder(std::move(folder)), m_host(host), m_log(m_folder)
{
}

Status TrainingRun::resume(const TrainingState& state)
{
    if (Status status = m_trainer.restore(state); !status)
        return status;
    const auto number = [&state](const char* name, double fallback) {
        const auto found = state.numbers.find(name);
        return found == state.numbers.end() ? fallback : found->second;
    };
    m_earlier_seconds = number("seconds", 0);
    m_best_score = number("best_score", kNoScore);
    m_best_step = number("best_step", -1);
    m_smoothed_loss = number("smoothed_loss", -1);
    m_lowest_loss = number("lowest_loss", -1);
    // A validation before the first step comes after that step's checkpoint.
    return m_log.resume_after(m_trainer.steps_done() > 0 ? m_trainer.steps_done() : -1);
}

double TrainingRun::seconds() const
{
    return m_earlier_seconds + std::chrono::duration<double>(Clock::now() - m_start).count();
}

Expected<RunEnd> TrainingRun::go(const std::function<bool()>& stop)
{
    if (Status status = begin(); !status)
        return status.error();
    if (m_settings.validate_first && m_first_step == 0)
        if (Status status = validate(); !status)
            return status.error();
    while (!m_trainer.finished()) {
        const Expected<StepReport> step = m_trainer.step(stop());
        if (!step)
            return step.error();
        const std::string number = std::to_string(m_trainer.steps_done());
        if (!step->finite)
            return end_badly("the loss or its gradient at step " + number + " is not a number");
        if (diverges(step->loss))
            return end_badly("the loss explodes: smoothed " + std::to_string(m_smoothed_loss) + " at step " + number +
                             ", lowest " + std::to_string(m_lowest_loss));
        add_up(*step);
        if (m_trainer.steps_done() % m_settings.validate_every == 0 || m_trainer.finished())
            if (Status status = validate(); !status)
                return status.error();
        if (m_group.writes()) {
            report(*step);
            save_checkpoint_in_time();
        }
        if (step->stop && !m_trainer.finished())
            return end(RunEnd::stopped);
    }
    return end(RunEnd::finished);
}

/// All processes start from what rank 0 has.
Status TrainingRun::begin()
{
    if (Status status = m_trainer.share_state(); !status)
        return status;
    torch::Tensor losses = torch::tensor({ m_smoothed_loss, m_lowest_loss }, torch::kDouble);
    if (Status status = m_group.broadcast(losses); !status)
        return status;
    m_smoothed_loss = losses[0].item<double>();
    m_lowest_loss = losses[1].item<double>();
    m_first_step = m_logged_step = m_trainer.steps_done();
    m_start = m_last_checkpoint = Clock::now();
    m_logged_seconds = seconds();
    return {};
}

/// All processes see the same loss, so all come to the same conclusion.
bool TrainingRun::diverges(double loss)
{
    m_smoothed_loss = m_smoothed_loss < 0 ? loss : kLossMemory * m_smoothed_loss + (1 - kLossMemory) * loss;
    m_lowest_loss = m_lowest_loss < 0 ? m_smoothed_loss : std::min(m_lowest_loss, m_smoothed_loss);
    return m_smoothed_loss > m_settings.divergence * m_lowest_loss;
}

void TrainingRun::add_up(const StepReport& step)
{
    m_data_seconds += step.data_seconds;
    m_learning_seconds += step.learning_seconds;
    m_step_seconds += step.data_seconds + step.learning_seconds + step.other_seconds;
    m_sums["loss"] += step.loss;
    m_sums["gradient_norm"] += step.gradient_norm;
    for (const auto& [name, value] : step.terms)
        m_sums[name] += value;
}

void TrainingRun::report(const StepReport& step)
{
    const std::int64_t done = m_trainer.steps_done();
    RunProgress progress;
    progress.step = done;
    progress.steps = m_steps;
    progress.steps_per_second = static_cast<double>(done - m_first_step) / (seconds() - m_earlier_seconds);
    progress.seconds_left = static_cast<double>(m_steps - done) / progress.steps_per_second;
    progress.data_share = m_data_seconds / m_step_seconds;
    progress.learning_share = m_learning_seconds / m_step_seconds;
    progress.report = step;
    progress.last_validation = m_last_validation;
    m_host.progress(progress);
    if (done % m_settings.log_every != 0 && !m_trainer.finished())
        return;
    const auto count = static_cast<double>(done - m_logged_step);
    nlohmann::ordered_json entry = { { "step", done },
                                     { "seconds", seconds() },
                                     { "steps_per_second", count / std::max(seconds() - m_logged_seconds, 1e-9) } };
    for (const auto& [name, sum] : m_sums)
        entry[name] = sum / count;
    entry["rate_factor"] = m_trainer.rate_factor_of(done - 1);
    entry["data_share"] = progress.data_share;
    entry["learning_share"] = progress.learning_share;
    log(entry);
    m_sums.clear();
    m_logged_step = done;
    m_logged_seconds = seconds();
}

void TrainingRun::log(const nlohmann::ordered_json& entry)
{
    const Status status = m_log.add(entry);
    if (!status && !m_log_failed)
        m_host.note("warning: " + status.error().message + "; the log will have gaps");
    m_log_failed = !status;
}

Status TrainingRun::validate()
{
    return m_group.rank_0_alone([this](const StillThere& still_there) { keep_if_best(still_there); });
}

void TrainingRun::keep_if_best(const StillThere& still_there)
{
    const std::int64_t step = m_trainer.steps_done();
    const std::optional<Validation> result = m_host.validate(m_trainer.averaged_model(), still_there);
    m_last_validation = result;
    if (result)
        log({ { "step", step },
              { "seconds", seconds() },
              { "score", result->score },
              { "psnr", result->psnr },
              { "angle", result->angle },
              { "validation", result->details } });
    // Without a test the latest is the best there is.
    const double score = result ? result->score : m_trainer.finished() ? 0 : kNoScore;
    if (!std::isfinite(score) || score <= m_best_score)
        return;
    const Status status = m_host.save_model(m_trainer.averaged_model(), m_folder + "/" + kBestFile, result, step);
    m_best_error = status.error().message;
    if (!status) {
        m_host.note("warning: the best model so far could not be saved: " + m_best_error);
        return;
    }
    m_best_score = score;
    m_best_step = static_cast<double>(step);
}

void TrainingRun::save_checkpoint_in_time()
{
    const double since = std::chrono::duration<double>(Clock::now() - m_last_checkpoint).count();
    const double interval = m_settings.checkpoint_minutes * 60;
    if (since >= (m_checkpoint_error.empty() ? interval : std::min(interval, kRetrySeconds)))
        save_checkpoint();
}

bool TrainingRun::save_checkpoint()
{
    if (!m_trainer.sound())
        return false; // the one that is there is better
    TrainingState state = m_trainer.state();
    state.texts = m_origin;
    state.numbers["seconds"] = seconds();
    state.numbers["best_score"] = m_best_score;
    state.numbers["best_step"] = m_best_step;
    state.numbers["smoothed_loss"] = m_smoothed_loss;
    state.numbers["lowest_loss"] = m_lowest_loss;
    const Status status = train::save_checkpoint(state, m_folder + "/" + kCheckpointFile);
    if (!status && m_checkpoint_error.empty())
        m_host.note("warning: no checkpoint: " + status.error().message +
                    "; the one before stays; trying again while training goes on");
    if (status && !m_checkpoint_error.empty())
        m_host.note("checkpoints can be written again");
    m_checkpoint_error = status.error().message;
    m_last_checkpoint = Clock::now();
    return m_checkpoint_error.empty();
}

Expected<RunEnd> TrainingRun::end_badly(const std::string& reason)
{
    if (!m_group.writes())
        return RunEnd::diverged;
    m_host.note(reason + "; training has stopped");
    const bool healthy = m_smoothed_loss <= m_settings.divergence * m_lowest_loss;
    if (healthy)
        save_checkpoint();
    std::string kept = m_folder + "/" + kCheckpointFile + (healthy ? " holds the state before it" : " is from before");
    if (m_best_step >= 0)
        kept += ", " + m_folder + "/" + kBestFile + " the best model, of step " +
                std::to_string(static_cast<std::int64_t>(m_best_step));
    m_host.note(kept +
                ". Try a lower optimizer.rate or optimizer.clip_norm, with --init and that model or with --restart");
    return RunEnd::diverged;
}

Expected<RunEnd> TrainingRun::end(RunEnd how)
{
    if (!m_group.writes())
        return how;
    save_checkpoint();
    if (!m_checkpoint_error.empty())
        return Error{ "the last checkpoint could not be written: " + m_checkpoint_error };
    if (how == RunEnd::finished && !m_best_error.empty())
        return Error{ "the best model could not be written: " + m_best_error };
    return how;
}

} // namespace srisp::train
