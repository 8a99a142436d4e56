// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

#include "train/evaluation/evaluation.h"
#include "train/learning/trainer.h"
#include "train/run/run_log.h"

namespace srisp::train {

/// When a run tests, logs and saves.
struct RunSettings {
    int validate_every = 200;
    int log_every = 10;
    double checkpoint_minutes = 3;
    double divergence = 5;
    bool validate_first = false; ///< not in recipes: a run that starts from a finished model keeps it if it is the best

    template<class Visitor> void describe(Visitor& v)
    {
        v.integer("validate_every", validate_every, 1, 100'000'000, "steps between two validations");
        v.integer("log_every", log_every, 1, 1'000'000, "steps between two lines of the log");
        v.number("checkpoint_minutes", checkpoint_minutes, 0, 1440, "between two checkpoints; 0: every step");
        v.number("divergence", divergence, 1.1, 1e9,
                 "stop when the smoothed loss exceeds its lowest value this many times");
    }
};

/// How far a run is.
struct RunProgress {
    std::int64_t step = 0, steps = 0;
    double steps_per_second = 0, seconds_left = 0;
    double data_share = 0, learning_share = 0; ///< of the time of the steps: making batches; forward and backward
    StepReport report;                         ///< of the last step
    std::optional<Validation> last_validation;
};

/// What a run needs from outside, and whom it tells.
class RunHost {
public:
    virtual ~RunHost() = default;
    /// Tests a model; nothing where there is nothing to test on. Calls `still_there` now and then: other processes
    /// wait.
    virtual std::optional<Validation> validate(Unprocessor& model, const StillThere& still_there) = 0;
    /// Writes a model file.
    virtual Status save_model(Unprocessor& model, const std::string& path, const std::optional<Validation>& result,
                              std::int64_t step) = 0;
    virtual void progress(const RunProgress& progress) = 0;
    /// Something that a person should know: one line.
    virtual void note(const std::string& line) = 0;
};

enum class RunEnd { finished, stopped, diverged };

/// The files of an output folder.
constexpr char kCheckpointFile[] = "checkpoint.safetensors", kBestFile[] = "best.safetensors";
constexpr char kRecipeFile[] = "recipe.json";

/// Runs a trainer to its end, with validations, logs and checkpoints in an output folder; only rank 0 writes.
class TrainingRun {
public:
    /// `origin`: what checkpoints keep so that only the same training goes on from them.
    TrainingRun(Trainer& trainer, ProcessGroup& group, const RunSettings& settings, std::int64_t steps,
                std::map<std::string, std::string> origin, std::string folder, RunHost& host);

    /// Goes on from a checkpoint of the same recipe. Call it on rank 0 only, before `go`.
    Status resume(const TrainingState& state);

    /// Writes a checkpoint; whether it could be written. Call it on rank 0 only.
    bool save_checkpoint();

    /// Trains until the end, until `stop` says so (a checkpoint is written then), or until the loss is no number or
    /// explodes. Errors: the last checkpoint or model could not be written; another process is gone.
    Expected<RunEnd> go(const std::function<bool()>& stop);

private:
    using Clock = std::chrono::steady_clock;

    bool diverges(double loss);
    void add_up(const StepReport& report);
    void report(const StepReport& step);
    Status begin();
    Status validate();
    void keep_if_best(const StillThere& still_there);
    void save_checkpoint_in_time();
    double seconds() const;
    void log(const nlohmann::ordered_json& entry);
    Expected<RunEnd> end_badly(const std::string& reason);
    Expected<RunEnd> end(RunEnd how);

    Trainer& m_trainer;
    ProcessGroup& m_group;
    RunSettings m_settings;
    std::int64_t m_steps;
    std::map<std::string, std::string> m_origin;
    std::string m_folder;
    RunHost& m_host;
    RunLog m_log;
    Clock::time_point m_start = Clock::now(), m_last_checkpoint = Clock::now();
    std::int64_t m_first_step = 0;
    double m_earlier_seconds = 0; ///< of the runs that this one goes on from
    double m_best_score = -1e300, m_best_step = -1;
    double m_smoothed_loss = -1, m_lowest_loss = -1;
    double m_data_seconds = 0, m_learning_seconds = 0, m_step_seconds = 0;
    double m_logged_seconds = 0;
    std::int64_t m_logged_step = 0;
    std::map<std::string, double> m_sums; ///< of losses and gradient norms since the last line of the log
    bool m_log_failed = false;
    std::string m_checkpoint_error, m_best_error;
    std::optional<Validation> m_last_validation;
};

} // namespace srisp::train
