// SPDX-License-Identifier: Apache-2.0
#include "anchor_start.h"

#include <chrono>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "base/printed.h"
#include "model/model_files.h"
#include "output_folder.h"
#include "train/run/model_file.h"

namespace srisp::tool {

using namespace train;

namespace {

/// The pairs that an anchor is fitted to, in a file of the output folder for as long as the fit lasts: every few
/// minutes, and when the program is told to stop.
class KeptPairs {
public:
    KeptPairs(const Session& session, Host& host, AnchorPairs& pairs);

    /// Goes on from those that an earlier run made, if it did. Fails where they are another training's.
    void find();

    /// To be called often, with the line that tells how far it is. Keeps them when it is time; after a signal at once,
    /// and throws Interrupted.
    void while_it_lasts(ProgressMeter& meter);

private:
    using Clock = std::chrono::steady_clock;
    void keep(ProgressMeter& meter);

    const Session& m_session;
    Host& m_host;
    AnchorPairs& m_pairs;
    std::string m_path;
    Clock::time_point m_last = Clock::now();
    int m_kept = 0;
};

KeptPairs::KeptPairs(const Session& session, Host& host, AnchorPairs& pairs)
    : m_session(session), m_host(host), m_pairs(pairs), m_path(session.settings().output + "/" + kAnchorPairsFile)
{
}

void KeptPairs::find()
{
    const std::optional<TrainingState> state = find_checkpoint(m_path, m_session.settings(), m_session.pack->hash());
    if (!state)
        return;
    const auto inputs = state->tensors.find("inputs"), means = state->tensors.find("means");
    if (inputs == state->tensors.end() || means == state->tensors.end() || !m_pairs.take(inputs->second, means->second))
        fail("'" + m_path + "' does not hold an anchor's pairs; --restart starts again");
    m_kept = m_pairs.made();
    m_host.note("going on from " + std::to_string(m_kept) + " of " + std::to_string(m_pairs.wanted()) +
                " pairs for the anchor");
}

void KeptPairs::while_it_lasts(ProgressMeter& meter)
{
    const double minutes = std::chrono::duration<double>(Clock::now() - m_last).count() / 60;
    const bool stopped = pending_interrupt() != 0;
    if (stopped || minutes >= m_session.settings().run.checkpoint_minutes)
        keep(meter);
    if (!stopped)
        return;
    meter.wipe();
    m_host.note("stopped with " + std::to_string(m_pairs.made()) + " of " + std::to_string(m_pairs.wanted()) +
                " pairs for the anchor; the same command goes on from " +
                (m_kept == 0                ? "the start"
                 : m_kept == m_pairs.made() ? "there"
                                            : std::to_string(m_kept)));
    check_interrupt();
}

void KeptPairs::keep(ProgressMeter& meter)
{
    m_last = Clock::now();
    if (m_pairs.made() == m_kept)
        return;
    TrainingState state;
    state.tensors = { { "inputs", m_pairs.inputs() }, { "means", m_pairs.means() } };
    state.texts = origin_of(m_session.settings(), m_session.pack->hash());
    if (const Status status = save_checkpoint(state, m_path))
        m_kept = m_pairs.made();
    else {
        meter.wipe();
        m_host.note("warning: the anchor's pairs are not kept: " + status.error().message);
    }
}

void take_anchor_of(const std::string& name, Unprocessor& model)
{
    const LoadedModel other = require(load_model(require(find_model_file(name))));
    if (const Status status = take_anchor(model, *other.model); !status)
        fail("anchor_fit.from: model '" + name + "' " + status.error().message);
}

/// Fills the pairs; the fit to them.
AnchorFit fit(Session& session, Host& host, AnchorPairs& pairs, const AnchorFitSettings& settings, bool quiet,
              bool restart, const StillThere& still_there)
{
    KeptPairs kept(session, host, pairs);
    if (!restart)
        kept.find();
    {
        ProgressMeter meter({ "srisptrain: for the anchor", "pairs", pairs.wanted(), pairs.made() }, !quiet);
        while (!pairs.complete()) {
            pairs.make_more(*session.samples);
            meter.show(pairs.made());
            require(still_there());
            kept.while_it_lasts(meter);
        }
    }
    ProgressMeter meter({ "srisptrain: fitting the anchor", "%", 100 }, !quiet);
    return fit_anchor(*session.model, pairs, settings, static_cast<std::uint64_t>(session.settings().seed),
                      [&](double part) {
                          meter.show(static_cast<std::int64_t>(part * 100));
                          require(still_there());
                          kept.while_it_lasts(meter);
                      });
}

void say(Host& host, const AnchorFit& fit)
{
    host.note(
        printed("anchor fitted: error of the log mean %.3f (a line alone %.3f, gain match %.3f), on pairs held out",
                fit.deviation, fit.line_deviation, fit.gain_match_deviation));
}

/// Of the anchors between the old one and the one that was carried on from it, the best in validation.
void take_best_mix(Session& session, Host& host, Unprocessor& before, const Validation& without,
                   const StillThere& still_there)
{
    const std::shared_ptr<Unprocessor> after = session.another();
    require(take_anchor(*after, *session.model));
    double best_share = 0, best_score = without.score;
    const auto say_one = [&host](double share, const Validation& validation) {
        host.note(printed("validation: %.2f dB and %.2f deg with %.0f %% of the new anchor", validation.psnr,
                          validation.angle, 100 * share));
    };
    say_one(0, without);
    for (const double share : { 0.25, 0.5, 0.75, 1.0 }) {
        mix_anchors(*session.model, before, *after, share);
        const Validation validation = *host.validate(*session.model, still_there);
        say_one(share, validation);
        if (validation.score > best_score) {
            best_score = validation.score;
            best_share = share;
        }
    }
    mix_anchors(*session.model, before, *after, best_share);
    if (best_share == 0)
        host.note("the model's own anchor stays");
}

} // namespace

std::optional<AnchorFitSettings> anchor_fit_of(const TrainingRecipe& recipe)
{
    AnchorFitSettings settings = recipe.anchor_fit;
    settings.carry_on = settings.carry_on && !recipe.init.empty(); // a new model has nothing to carry on
    if (!settings.from.empty() || (!recipe.init.empty() && !settings.carry_on))
        return {};
    return settings;
}

void start_anchor(Session& session, Host& host, bool quiet, bool restart, const StillThere& still_there)
{
    const TrainingRecipe& recipe = session.settings();
    const std::optional<AnchorFitSettings> settings = anchor_fit_of(recipe);
    if (!settings) {
        if (const AnchorFitSettings& wanted = recipe.anchor_fit;
            !wanted.from.empty() && (recipe.init.empty() || wanted.carry_on))
            take_anchor_of(wanted.from, *session.model);
        return;
    }
    std::optional<AnchorPairs> pairs = pairs_for_anchor(*session.model, *settings);
    if (!pairs)
        return;
    std::shared_ptr<Unprocessor> before;
    std::optional<Validation> without;
    if (settings->carry_on) {
        before = session.another();
        require(take_anchor(*before, *session.model));
        without = host.validate(*session.model, still_there);
    }
    say(host, fit(session, host, *pairs, *settings, quiet, restart, still_there));
    if (without)
        take_best_mix(session, host, *before, *without, still_there);
    fit_anchor_deviation(*session.model, *pairs, static_cast<std::uint64_t>(recipe.seed));
}

} // namespace srisp::tool
