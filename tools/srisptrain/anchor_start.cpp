// SPDX-License-Identifier: Apache-2.0
#include "anchor_start.h"

#include <cstdio>

#include "../common/failure.h"
#include "kept_pairs.h"
#include "model/model_files.h"
#include "model_file.h"

namespace srisp::tool {

using namespace train;

namespace {

void take_anchor_of(const std::string& name, Unprocessor& model)
{
    const LoadedModel other = require(load_model(require(find_model_file(name))));
    if (const Status status = take_anchor(model, *other.model); !status)
        fail("anchor_fit.from: model '" + name + "' " + status.error().message);
}

/// Nothing where the model has no anchor to fit.
std::optional<AnchorFit> fit(Session& session, Host& host, const AnchorFitSettings& settings, bool quiet, bool restart,
                             const std::function<void()>& still_there)
{
    std::optional<AnchorPairs> pairs = pairs_for_anchor(*session.model, settings);
    if (!pairs)
        return {};
    KeptPairs kept(session, host, *pairs);
    if (!restart)
        kept.find();
    {
        ProgressMeter meter({ "srisptrain: for the anchor", "pairs", pairs->wanted(), pairs->made() }, !quiet);
        while (!pairs->complete()) {
            pairs->make_more(*session.samples);
            meter.show(pairs->made());
            still_there();
            kept.while_it_lasts(meter);
        }
    }
    ProgressMeter meter({ "srisptrain: fitting the anchor", "%", 100 }, !quiet);
    return fit_anchor(*session.model, *pairs, settings, static_cast<std::uint64_t>(session.settings().seed),
                      [&](double part) {
                          meter.show(static_cast<std::int64_t>(part * 100));
                          still_there();
                          kept.while_it_lasts(meter);
                      });
}

void say(Host& host, const AnchorFit& fit)
{
    char text[160];
    std::snprintf(text, sizeof text,
                  "anchor fitted: error of the log mean %.3f (a line alone %.3f, gain match %.3f), on pairs held out",
                  fit.deviation, fit.line_deviation, fit.gain_match_deviation);
    host.note(text);
}

/// Whether the validation is better with the new anchor.
bool helps(Host& host, const Validation& with, const Validation& without)
{
    char text[160];
    std::snprintf(text, sizeof text, "validation: %.2f dB and %.2f deg with it, %.2f dB and %.2f deg without",
                  with.psnr, with.angle, without.psnr, without.angle);
    host.note(text);
    return with.score > without.score;
}

} // namespace

std::optional<AnchorFitSettings> anchor_fit_of(const Recipe& recipe)
{
    AnchorFitSettings settings = recipe.anchor_fit;
    settings.carry_on = settings.carry_on && !recipe.init.empty(); // a new model has nothing to carry on
    if (!settings.from.empty() || (!recipe.init.empty() && !settings.carry_on))
        return {};
    return settings;
}

void start_anchor(Session& session, Host& host, bool quiet, bool restart, const std::function<void()>& still_there)
{
    const Recipe& recipe = session.settings();
    const std::optional<AnchorFitSettings> settings = anchor_fit_of(recipe);
    if (!settings) {
        if (const AnchorFitSettings& wanted = recipe.anchor_fit;
            !wanted.from.empty() && (recipe.init.empty() || wanted.carry_on))
            take_anchor_of(wanted.from, *session.model);
        return;
    }
    std::shared_ptr<Unprocessor> before;
    std::optional<Validation> without;
    if (settings->carry_on) {
        before = session.another();
        if (take_anchor(*before, *session.model))
            without = host.validate(*session.model, still_there);
    }
    const std::optional<AnchorFit> done = fit(session, host, *settings, quiet, restart, still_there);
    if (!done)
        return;
    say(host, *done);
    if (!without || helps(host, *host.validate(*session.model, still_there), *without))
        return;
    host.note("the model's own anchor stays");
    if (const Status status = take_anchor(*session.model, *before); !status)
        fail(status.error().message);
}

} // namespace srisp::tool
