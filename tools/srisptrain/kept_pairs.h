// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "anchor_pairs.h"
#include "host.h"

namespace srisp::tool {

constexpr char kAnchorPairsFile[] = "anchor_pairs.safetensors";

/// The pairs that an anchor is fitted to, in a file of the output folder for as long as the fit lasts: every few
/// minutes, and when the program is told to stop.
class KeptPairs {
public:
    KeptPairs(const Session& session, Host& host, train::AnchorPairs& pairs);

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
    train::AnchorPairs& m_pairs;
    std::string m_path;
    Clock::time_point m_last = Clock::now();
    int m_kept = 0;
};

} // namespace srisp::tool
