// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace srisp::tool {

/// "45 s", "12 min", "3 h 20 min"
std::string duration_text(double seconds);

/// "srisppack: 1200 of 3458 images, 310/s, 7 s left" on stderr, once two seconds have passed: one line that is renewed
/// on a terminal and wiped at the end, elsewhere a line every half minute.
class ProgressMeter {
public:
    /// `title`: begins the line; `unit`: what is counted, plural; `before`: done by an earlier run, which took no time.
    ProgressMeter(std::string title, std::string unit, std::int64_t total, bool enabled, std::int64_t before = 0);
    ~ProgressMeter() { wipe(); }
    ProgressMeter(const ProgressMeter&) = delete;
    ProgressMeter& operator=(const ProgressMeter&) = delete;

    void show(std::int64_t done);
    /// Before something else is printed.
    void wipe();

private:
    using Clock = std::chrono::steady_clock;

    std::string m_title, m_unit;
    std::int64_t m_total, m_before;
    bool m_enabled, m_terminal, m_shown = false;
    Clock::time_point m_start, m_last;
};

} // namespace srisp::tool
