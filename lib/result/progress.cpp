// SPDX-License-Identifier: Apache-2.0
#include "result/progress.h"

#include <cstdio>

namespace srisp {

void ProgressLine::show(double part)
{
    const auto now = Clock::now();
    if (!m_enabled || now - m_start < std::chrono::seconds(2) || now - m_last < std::chrono::milliseconds(100))
        return;
    m_last = now;
    m_shown = true;
    std::fprintf(stderr, "\rsrisp: %3.0f %%", part * 100);
    std::fflush(stderr);
}

void ProgressLine::wipe()
{
    if (m_shown)
        std::fputs("\r           \r", stderr);
    m_shown = false;
}

} // namespace srisp
