// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "training_run.h"

namespace srisp::tool {

/// "120/2400, 1.9/s, loss 0.043 (reverse 0.031, forward 0.012), 33.2 dB, 6.1 deg, 20 min left"
std::string progress_text(const train::Progress& progress);

/// How a training goes, on stderr: on a terminal one line that is renewed, elsewhere one every half minute.
class ProgressLine {
public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine() { wipe(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const train::Progress& progress);
    /// A line that stays, said even when quiet.
    void note(const std::string& line);

private:
    using Clock = std::chrono::steady_clock;
    void wipe();

    bool m_quiet, m_terminal, m_shown = false;
    Clock::time_point m_last = Clock::now();
};

} // namespace srisp::tool
