// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

namespace srisp {

/// "45 s", "12 min", "3 h 20 min"
std::string duration_text(double seconds);

/// Environment variable with the file descriptor of the terminal that progress goes to where stderr leads elsewhere:
/// what a program that runs another leaves to it.
constexpr char kTerminalVariable[] = "SRISP_TERMINAL";

/// How far work has come, on stderr, once it has taken two seconds: on a terminal one line that is renewed, as wide as
/// the terminal at most, and wiped at the end; elsewhere a line every half minute.
class ProgressLine {
public:
    explicit ProgressLine(bool enabled);
    ~ProgressLine() { wipe(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Cheap: `text()` makes the line, and is called only when one is due.
    template<class Text> void show(const Text& text)
    {
        if (due())
            print(text());
    }
    /// Before something else is printed.
    void wipe();

private:
    using Clock = std::chrono::steady_clock;

    bool due();
    void print(const std::string& text);

    bool m_enabled;
    int m_file; ///< where it is shown
    bool m_terminal, m_shown = false;
    Clock::time_point m_start, m_last;
};

/// Work that is counted: "srisppack: 1200 of 3458 images, 310/s, 7 s left".
struct WorkCount {
    std::string title, unit; ///< what begins the line; what is counted, plural
    std::int64_t total;
    std::int64_t before = 0; ///< done by an earlier run, which took no time

    std::string text(std::int64_t done, double seconds) const;
};

/// The progress line of work that is counted.
class ProgressMeter {
public:
    ProgressMeter(WorkCount count, bool enabled) : m_count(std::move(count)), m_line(enabled) {}

    void show(std::int64_t done);
    void wipe() { m_line.wipe(); }

private:
    using Clock = std::chrono::steady_clock;

    WorkCount m_count;
    ProgressLine m_line;
    Clock::time_point m_start = Clock::now();
};

} // namespace srisp
