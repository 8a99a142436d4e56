// SPDX-License-Identifier: Apache-2.0
#include "progress_meter.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace srisp::tool {

ProgressMeter::ProgressMeter(std::string title, std::string unit, std::int64_t total, bool enabled, std::int64_t before)
    : m_title(std::move(title)), m_unit(std::move(unit)), m_total(total), m_before(before), m_enabled(enabled),
      m_terminal(isatty(STDERR_FILENO) == 1), m_start(Clock::now()), m_last(m_start)
{
}

std::string duration_text(double seconds)
{
    const long whole = std::max(1L, long(seconds + 0.5));
    if (whole < 100)
        return std::to_string(whole) + " s";
    const long minutes = (whole + 30) / 60;
    return (minutes < 60 ? "" : std::to_string(minutes / 60) + " h ") + std::to_string(minutes % 60) + " min";
}

void ProgressMeter::show(std::int64_t done)
{
    const auto now = Clock::now();
    const auto pause = m_terminal ? std::chrono::milliseconds(200) : std::chrono::milliseconds(30'000);
    if (!m_enabled || done <= m_before || now - m_start < std::chrono::seconds(2) || now - m_last < pause)
        return;
    m_last = now;
    m_shown = m_terminal;
    const double rate = double(done - m_before) / std::chrono::duration<double>(now - m_start).count();
    std::fprintf(stderr, "%s%s: %lld of %lld %s, %.*f/s, %s left%s", m_terminal ? "\r\033[K" : "", m_title.c_str(),
                 static_cast<long long>(done), static_cast<long long>(m_total), m_unit.c_str(), rate < 10 ? 1 : 0, rate,
                 duration_text(double(m_total - done) / rate).c_str(), m_terminal ? "" : "\n");
    std::fflush(stderr);
}

void ProgressMeter::wipe()
{
    if (m_shown)
        std::fputs("\r\033[K", stderr);
    m_shown = false;
}

} // namespace srisp::tool
