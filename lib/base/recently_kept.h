// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <list>
#include <mutex>
#include <string>
#include <utility>

namespace srisp {

/// Pointers by name, at most so many: the one that was used longest ago goes first. Thread safe.
template<class Pointer> class RecentlyKept {
public:
    explicit RecentlyKept(std::size_t most) : m_most(most) {}

    /// Null if there is none.
    Pointer find(const std::string& key)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return moved_to_front(key);
    }

    /// Another thread may have kept one meanwhile: the first one stays, and is returned.
    Pointer keep(const std::string& key, Pointer pointer)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (Pointer first = moved_to_front(key))
            return first;
        m_entries.emplace_front(key, pointer);
        if (m_entries.size() > m_most)
            m_entries.pop_back();
        return pointer;
    }

private:
    Pointer moved_to_front(const std::string& key)
    {
        for (auto entry = m_entries.begin(); entry != m_entries.end(); ++entry)
            if (entry->first == key) {
                m_entries.splice(m_entries.begin(), m_entries, entry);
                return entry->second;
            }
        return {};
    }

    std::mutex m_mutex;
    std::size_t m_most;
    std::list<std::pair<std::string, Pointer>> m_entries;
};

} // namespace srisp
