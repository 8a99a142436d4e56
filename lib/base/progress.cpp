// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "base/printed.h"

namespace srisp {

std::string duration_text(double seconds)
{
    const long whole = std::max(1L, long(seconds + 0.5));
    if (whole < 100)
        return std::to_string(whole) + " s";
    const long minutes = (whole + 30) / 60;
    return (minutes < 60 ? "" : std::to_string(minutes / 60) + " h ") + std::to_string(minutes % 60) + " min";
}

static int file_for_progress()
{
    const char* const variable = std::getenv(kTerminalVariable);
    const int file = variable ? std::atoi(variable) : 0;
    return file > STDERR_FILENO && isatty(file) ? file : STDERR_FILENO;
}

/// What fits into one line of the terminal: a line that is broken cannot be renewed.
static std::string fitted(int terminal, const std::string& text)
{
    winsize size{};
    if (ioctl(terminal, TIOCGWINSZ, &size) != 0 || size.ws_col < 2)
        return text;
    return text.substr(0, size.ws_col - 1u);
}

ProgressLine::ProgressLine(bool enabled)
    : m_enabled(enabled), m_file(file_for_progress()), m_terminal(isatty(m_file) == 1), m_start(Clock::now()),
      m_last(m_start)
{
}

bool ProgressLine::due()
{
    const auto now = Clock::now();
    const auto pause = m_terminal ? std::chrono::milliseconds(200) : std::chrono::milliseconds(30'000);
    if (!m_enabled || now - m_start < std::chrono::seconds(2) || now - m_last < pause)
        return false;
    m_last = now;
    return true;
}

void ProgressLine::print(const std::string& text)
{
    m_shown = m_terminal;
    if (m_terminal)
        dprintf(m_file, "\r\033[K%s", fitted(m_file, text).c_str());
    else
        dprintf(m_file, "%s\n", text.c_str());
}

void ProgressLine::wipe()
{
    if (m_shown)
        dprintf(m_file, "\r\033[K");
    m_shown = false;
}

std::string WorkCount::text(std::int64_t done, double seconds) const
{
    const double rate = double(done - before) / seconds;
    return title + ": " + std::to_string(done) + " of " + std::to_string(total) + " " + unit + ", " +
           printed("%.*f/s", rate < 10 ? 1 : 0, rate) + ", " + duration_text(double(total - done) / rate) + " left";
}

void ProgressMeter::show(std::int64_t done)
{
    if (done > m_count.before)
        m_line.show([&] { return m_count.text(done, std::chrono::duration<double>(Clock::now() - m_start).count()); });
}

} // namespace srisp
