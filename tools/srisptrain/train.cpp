// SPDX-License-Identifier: Apache-2.0
#include "train.h"

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "anchor_start.h"
#include "base/output_file.h"
#include "output_folder.h"

namespace srisp::tool {

using namespace train;

namespace {

/// Rank 0: where the training starts; at step 0 without a `state`.
void start(const TrainingRecipe& recipe, const std::optional<TrainingState>& state, TrainingRun& run,
           OutputFolder& folder, Host& host)
{
    bool kept = true;
    if (state) {
        if (const Status status = run.resume(*state); !status)
            fail("'" + folder.file(kCheckpointFile) + "' " + status.error().message);
        host.note("going on from step " + std::to_string(static_cast<std::int64_t>(state->numbers.at("step"))));
    } else {
        folder.clear(); // of what is not gone on from
        // The fit of the anchor may have taken long.
        kept = run.save_checkpoint();
    }
    if (kept)
        folder.remove(kAnchorPairsFile);
    require(write_output_file(folder.file(kRecipeFile), recipe_text(recipe)));
}

} // namespace

int train_model(Session& session, const TrainOptions& options)
{
    const TrainingRecipe& recipe = session.settings();
    Host host(session, options.quiet);
    std::optional<OutputFolder> folder;
    const bool writes = session.group->writes();
    if (writes) {
        folder.emplace(recipe.output);
        if (!session.tests)
            host.note("no validation: " + session.tests_missing + "; the last model is kept");
    }
    watch_interrupts();
    std::optional<TrainingState> state;
    require(session.group->rank_0_alone([&](const StillThere& still_there) {
        if (!options.restart)
            state = find_checkpoint(folder->file(kCheckpointFile), recipe, session.pack->hash());
        if (!state)
            start_anchor(session, host, options.quiet, options.restart, still_there);
    }));
    Trainer trainer(
        recipe.trainer, session.model, [&session] { return session.another(); }, session.samples, *session.group,
        session.device, static_cast<std::uint64_t>(recipe.seed));
    RunSettings run_settings = recipe.run;
    run_settings.validate_first = !recipe.init.empty();
    TrainingRun run(trainer, *session.group, run_settings, recipe.trainer.steps,
                    origin_of(recipe, session.pack->hash()), recipe.output, host);
    if (writes)
        start(recipe, state, run, *folder, host);
    const RunEnd end = require(run.go([] { return pending_interrupt() != 0; }));
    if (end == RunEnd::diverged)
        return kExitFailed;
    if (end == RunEnd::stopped) {
        if (writes)
            host.note("stopped after step " + std::to_string(trainer.steps_done()) +
                      "; the same command goes on from there");
        return pending_interrupt() ? 128 + pending_interrupt() : kExitFailed;
    }
    return 0;
}

int test_only(Session& session, const TrainOptions& options)
{
    const TrainingRecipe& recipe = session.settings();
    Host host(session, options.quiet);
    if (!session.tests)
        fail("'" + recipe.model.method +
             "' has nothing to learn, and the pack nothing to test it on: " + session.tests_missing);
    OutputFolder folder(recipe.output);
    folder.clear();
    host.note("'" + recipe.model.method + "' has nothing to learn: it is only tested");
    const std::optional<Validation> result = host.validate(*session.model, [] { return Status(); });
    require(write_output_file(folder.file(kRecipeFile), recipe_text(recipe)));
    RunLog log(recipe.output);
    require(log.add({ { "step", 0 },
                      { "score", result->score },
                      { "psnr", result->psnr },
                      { "angle", result->angle },
                      { "validation", result->details } }));
    require(host.save_model(*session.model, folder.file(kBestFile), result, 0));
    std::printf("%.2f dB, %.2f°\n", result->psnr, result->angle);
    return 0;
}

} // namespace srisp::tool
