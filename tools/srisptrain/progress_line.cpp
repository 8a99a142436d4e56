// SPDX-License-Identifier: Apache-2.0
#include "progress_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

#include "../common/progress_meter.h"

namespace srisp::tool {

using train::Progress;

static std::string number_text(const char* format, double value)
{
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string progress_text(const Progress& progress)
{
    std::string text = std::to_string(progress.step) + "/" + std::to_string(progress.steps) + ", " +
                       number_text(progress.steps_per_second < 10 ? "%.2f/s" : "%.0f/s", progress.steps_per_second) +
                       ", loss " + number_text("%.4f", progress.report.loss);
    std::string terms;
    for (const auto& [name, value] : progress.report.terms)
        terms += (terms.empty() ? " (" : ", ") + name + " " + number_text("%.4f", value);
    text += terms.empty() ? "" : terms + ")";
    if (progress.last_validation)
        text += ", " + number_text("%.2f dB, ", progress.last_validation->psnr) +
                number_text("%.2f deg", progress.last_validation->angle);
    return text + ", " + duration_text(progress.seconds_left) + " left";
}

/// What fits into one line of the terminal: a line that is broken cannot be renewed.
static std::string fitted(const std::string& text)
{
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2)
        return text;
    return text.substr(0, size.ws_col - 1u);
}

ProgressLine::ProgressLine(bool quiet) : m_quiet(quiet), m_terminal(isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const Progress& progress)
{
    const auto now = Clock::now();
    const auto pause = m_terminal ? std::chrono::milliseconds(200) : std::chrono::milliseconds(30'000);
    if (m_quiet || now - m_last < pause)
        return;
    m_last = now;
    m_shown = m_terminal;
    const std::string text = progress_text(progress);
    if (m_terminal)
        std::fprintf(stderr, "\r\033[K%s", fitted(text).c_str());
    else
        std::fprintf(stderr, "%s\n", text.c_str());
    std::fflush(stderr);
}

void ProgressLine::note(const std::string& line)
{
    wipe();
    std::fprintf(stderr, "srisptrain: %s\n", line.c_str());
}

void ProgressLine::wipe()
{
    if (m_shown)
        std::fputs("\r\033[K", stderr);
    m_shown = false;
}

} // namespace srisp::tool
