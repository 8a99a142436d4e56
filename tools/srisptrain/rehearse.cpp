// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <ATen/Parallel.h>

#include "../common/failure.h"
#include "anchor_start.h"
#include "base/progress.h"
#include "output_folder.h"
#include "train.h"

namespace srisp::tool {

using namespace train;

namespace {

constexpr int kWarmUp = 2, kMeasured = 4; // steps
constexpr int kAnchorPairs = 512, kAnchorSteps = 100;

double seconds_of(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_inputs(const Session& session)
{
    const TrainingRecipe& recipe = session.settings();
    const TrainingPack& pack = *session.pack;
    std::int64_t count = 0;
    for (const torch::Tensor& parameter : session.model->parameters())
        count += parameter.numel();
    std::printf("recipe      %s\n", session.recipe.name.c_str());
    std::printf("model       %s, %lld parameters%s\n", recipe.model.method.c_str(), static_cast<long long>(count),
                recipe.init.empty() ? "" : (", starting from " + recipe.init).c_str());
    std::printf("pack        %s: %zu photos, %zu RAW images, %zu cameras (crops counted)\n", recipe.pack.c_str(),
                pack.photos().entries.size(), pack.raws().entries.size(), pack.cameras().names.size());
    std::printf("batch       %d pairs + %d photos for the mean teacher, %d px; %d process%s\n", recipe.trainer.pairs,
                recipe.trainer.unpaired, recipe.data.image_size, session.group->size(),
                session.group->size() == 1 ? "" : "es");
    std::printf("device      %s, %d threads\n", session.device.str().c_str(), at::get_num_threads());
    if (session.tests)
        std::printf("validation  %d crops every %d steps\n", session.tests->crops(), recipe.run.validate_every);
    else
        std::printf("validation  none: %s\n", session.tests_missing.c_str());
}

/// Whether it starts at step 0 is returned, too.
bool print_output(const Session& session, const TrainOptions& options)
{
    const TrainingRecipe& recipe = session.settings();
    const auto state = options.restart
                           ? std::nullopt
                           : find_checkpoint(recipe.output + "/" + kCheckpointFile, recipe, session.pack->hash());
    std::printf("output      %s: %s\n", recipe.output.c_str(),
                state
                    ? ("goes on from step " + std::to_string(static_cast<long long>(state->numbers.at("step")))).c_str()
                    : "starts at step 0");
    return !state;
}

/// Seconds that fitting the anchor will take, from a few of its pairs and steps; 0 where there is none to fit.
double anchor_seconds(Session& session)
{
    const TrainingRecipe& recipe = session.settings();
    std::optional<AnchorFitSettings> few = anchor_fit_of(recipe);
    if (!few)
        return 0;
    few->pairs = std::min(few->pairs, kAnchorPairs);
    few->steps = kAnchorSteps;
    std::optional<AnchorPairs> pairs = pairs_for_anchor(*session.model, *few);
    if (!pairs)
        return 0;
    const double making = seconds_of([&] {
        while (!pairs->complete())
            pairs->make_more(*session.samples);
    });
    const double fitting = seconds_of([&] { fit_anchor(*session.model, *pairs, *few, std::uint64_t(recipe.seed)); });
    return making * recipe.anchor_fit.pairs / few->pairs + fitting * recipe.anchor_fit.steps / few->steps;
}

/// MB that this process had at most so far.
double peak_memory_mb()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

} // namespace

int rehearse(Session& session, const TrainOptions& options)
{
    const TrainingRecipe& recipe = session.settings();
    double anchor = 0;
    if (session.group->writes()) {
        print_inputs(session);
        if (print_output(session, options) && session.learns())
            anchor = anchor_seconds(session);
    }
    if (!session.learns())
        return 0;
    // The later steps cost most: with the teacher's pairs.
    TrainerSettings settings = recipe.trainer;
    settings.mean_teacher.start = 0;
    Host host(session, true);
    Trainer trainer(
        settings, session.model, [&session] { return session.another(); }, session.samples, *session.group,
        session.device, static_cast<std::uint64_t>(recipe.seed));
    double data = 0, learning = 0;
    for (int i = 0; i < kWarmUp; ++i)
        require(trainer.step());
    const double step = seconds_of([&] {
                            for (int i = 0; i < kMeasured; ++i) {
                                const StepReport report = require(trainer.step());
                                data += report.data_seconds;
                                learning += report.learning_seconds;
                            }
                        }) /
                        kMeasured;
    const double validation = seconds_of([&] { host.validate(trainer.averaged_model(), [] { return Status(); }); });
    if (!session.group->writes())
        return 0;
    const int validations = (recipe.trainer.steps + recipe.run.validate_every - 1) / recipe.run.validate_every;
    std::printf("a step      %.3f s (forward and backward %.0f %%, making the batch %.0f %%), a validation %.1f s\n",
                step, 100 * learning / (step * kMeasured), 100 * data / (step * kMeasured), validation);
    if (anchor > 0)
        std::printf("anchor      about %s before the first step\n", duration_text(anchor).c_str());
    std::printf("in all      %d steps: about %s\n", recipe.trainer.steps,
                duration_text(anchor + recipe.trainer.steps * step + validations * validation).c_str());
    std::printf("memory      %.0f MB of this process\n", peak_memory_mb());
    return 0;
}

} // namespace srisp::tool
