// SPDX-License-Identifier: Apache-2.0
#include "kept_pairs.h"

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "output_folder.h"

namespace srisp::tool {

using namespace train;

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

} // namespace srisp::tool
