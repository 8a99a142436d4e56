// SPDX-License-Identifier: Apache-2.0
#include "watch.h"

#include "base/recently_kept.h"

namespace srisp::tool {

FileWatch::FileWatch(std::vector<std::string> paths)
    : m_paths(std::move(paths)), m_reported(state()), m_last(m_reported)
{
}

std::string FileWatch::state() const
{
    std::string text;
    for (const std::string& path : m_paths)
        text += file_state(path) + "\n";
    return text;
}

bool FileWatch::changed()
{
    const std::string now = state();
    const bool steady = now == m_last;
    m_last = now;
    if (!steady || now == m_reported)
        return false;
    m_reported = now;
    return true;
}

} // namespace srisp::tool
