// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace srisp {

/// One line on stderr that counts up once two seconds have passed, and is wiped at the end.
class ProgressLine {
public:
    explicit ProgressLine(bool enabled) : m_enabled(enabled), m_start(Clock::now()), m_last(m_start) {}
    ~ProgressLine() { wipe(); }

    void show(double part);
    void wipe();

private:
    using Clock = std::chrono::steady_clock;

    bool m_enabled, m_shown = false;
    Clock::time_point m_start, m_last;
};

} // namespace srisp
