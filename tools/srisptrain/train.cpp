// SPDX-License-Identifier: Apache-2.0
#include "train.h"

#include <cstdio>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "host.h"
#include "output_file.h"
#include "output_folder.h"

namespace srisp {

using namespace train;

namespace {

void write_or_fail(const std::string& path, const std::string& text)
{
    if (const Status status = write_output_file(path, text); !status)
        fail(status.error().message);
}

void say_anchor(Host& host, const AnchorFit& fit)
{
    char text[160];
    std::snprintf(text, sizeof text,
                  "anchor fitted: error of the log mean %.3f (a line alone %.3f, gain match %.3f), on pairs held out",
                  fit.deviation, fit.line_deviation, fit.gain_match_deviation);
    host.note(text);
}

/// Rank 0: what is done before the first step. A further fit of a finished model's anchor is taken back where the
/// validation says that it does harm, as it can with few images.
void prepare(Session& session, Host& host, bool quiet, const std::function<void()>& still_there)
{
    std::shared_ptr<Unprocessor> before;
    std::optional<Validation> without;
    if (carries_anchor_on(session.settings())) {
        before = session.another();
        if (take_anchor(*before, *session.model))
            without = host.validate(*session.model, still_there);
    }
    const std::optional<AnchorFit> fit = start_model(session, quiet, still_there);
    if (!fit)
        return;
    say_anchor(host, *fit);
    if (!without)
        return;
    const std::optional<Validation> with = host.validate(*session.model, still_there);
    char text[160];
    std::snprintf(text, sizeof text, "validation: %.2f dB and %.2f deg with it, %.2f dB and %.2f deg without",
                  with->psnr, with->angle, without->psnr, without->angle);
    host.note(text);
    if (with->score > without->score)
        return;
    host.note("the model's own anchor stays");
    if (const Status status = take_anchor(*session.model, *before); !status)
        fail(status.error().message);
}

/// Rank 0: where the training starts.
void start(Session& session, TrainingRun& run, OutputFolder& folder, Host& host, bool restart)
{
    const Recipe& recipe = session.settings();
    if (restart)
        folder.clear();
    if (const auto state = find_checkpoint(recipe.output, recipe, session.pack->hash())) {
        if (const Status status = run.resume(*state); !status)
            fail("'" + folder.file(kCheckpointFile) + "' " + status.error().message);
        host.note("going on from step " + std::to_string(static_cast<std::int64_t>(state->numbers.at("step"))));
    } else {
        folder.clear(); // of a log without a checkpoint
    }
    write_or_fail(folder.file(kRecipeFile), recipe_text(recipe));
}

} // namespace

int train_model(Session& session, const Options& options)
{
    const Recipe& recipe = session.settings();
    Host host(session, options.quiet);
    std::optional<OutputFolder> folder;
    const bool writes = session.group->writes();
    if (writes) {
        folder.emplace(recipe.output);
        if (!session.tests)
            host.note("no validation: " + session.tests_missing + "; the last model is kept");
    }
    session.group->rank_0_alone([&](const std::function<void()>& still_there) {
        if (options.restart || !find_checkpoint(recipe.output, recipe, session.pack->hash()))
            prepare(session, host, options.quiet, still_there);
    });
    Trainer trainer(
        recipe.trainer, session.model, [&session] { return session.another(); }, session.samples, *session.group,
        session.device, static_cast<std::uint64_t>(recipe.seed));
    RunSettings run_settings = recipe.run;
    run_settings.validate_first = !recipe.init.empty();
    TrainingRun run(trainer, *session.group, run_settings, recipe.trainer.steps,
                    origin_of(recipe, session.pack->hash()), recipe.output, host);
    if (writes)
        start(session, run, *folder, host, options.restart);
    watch_interrupts();
    const Expected<RunEnd> end = run.go([] { return pending_interrupt() != 0; });
    if (!end)
        fail(end.error().message);
    if (*end == RunEnd::diverged)
        return kExitFailed;
    if (*end == RunEnd::stopped) {
        if (writes)
            host.note("stopped after step " + std::to_string(trainer.steps_done()) +
                      "; the same command goes on from there");
        return pending_interrupt() ? 128 + pending_interrupt() : kExitFailed;
    }
    return 0;
}

int test_only(Session& session, const Options& options)
{
    const Recipe& recipe = session.settings();
    Host host(session, options.quiet);
    if (!session.tests)
        fail("'" + recipe.model.method +
             "' has nothing to learn, and the pack nothing to test it on: " + session.tests_missing);
    OutputFolder folder(recipe.output);
    folder.clear();
    host.note("'" + recipe.model.method + "' has nothing to learn: it is only tested");
    const std::optional<Validation> result = host.validate(*session.model, [] {});
    write_or_fail(folder.file(kRecipeFile), recipe_text(recipe));
    RunLog log(recipe.output);
    if (const Status status = log.add({ { "step", 0 },
                                        { "score", result->score },
                                        { "psnr", result->psnr },
                                        { "angle", result->angle },
                                        { "validation", result->details } });
        !status)
        fail(status.error().message);
    if (const Status status = host.save_model(*session.model, folder.file(kBestFile), result, 0); !status)
        fail(status.error().message);
    std::printf("%.2f dB, %.2f°\n", result->psnr, result->angle);
    return 0;
}

} // namespace srisp
