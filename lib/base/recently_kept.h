// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <future>
#include <list>
#include <mutex>
#include <string>
#include <utility>

#include <srisp/expected.h>

namespace srisp {

/// Path and state (device, inode, size, modification time in ns) of a file: a key for what was made from it. Only the
/// path where there is no such file.
std::string file_state(const std::string& path);

/// Pointers by key, at most so many: the one that was used longest ago goes first. Thread safe.
template<class Pointer> class RecentlyKept {
public:
    explicit RecentlyKept(std::size_t most) : m_most(most) {}

    /// From now on so many.
    void set_most(std::size_t most)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_most = most;
    }

    /// Null if there is none, or none yet.
    Pointer find(const std::string& key)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return moved_to_front(key) ? made(m_entries.front()) : Pointer{};
    }

    /// Another thread may have kept one meanwhile: the first one stays, and is returned.
    Pointer keep(const std::string& key, Pointer pointer)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (moved_to_front(key))
            if (Pointer first = made(m_entries.front()))
                return first;
        std::promise<Result> promise;
        promise.set_value(pointer);
        add(key, promise);
        return pointer;
    }

    /// The kept one, else what `make()` gives, an Expected<Pointer>. Requests for one that is being made wait for it.
    /// Failures are not kept: what failed for want of memory may work next time.
    template<class Make> Expected<Pointer> get(const std::string& key, const Make& make)
    {
        std::promise<Result> promise;
        std::shared_future<Result> other;
        {
            const std::lock_guard<std::mutex> lock(m_mutex);
            if (moved_to_front(key))
                other = m_entries.front().result;
            else
                add(key, promise);
        }
        if (other.valid())
            return other.get();
        try {
            Result result = make();
            if (!result)
                forget(key);
            promise.set_value(result);
            return result;
        } catch (...) {
            forget(key);
            promise.set_exception(std::current_exception());
            throw;
        }
    }

private:
    using Result = Expected<Pointer>;
    struct Entry {
        std::string key;
        std::shared_future<Result> result;
    };

    bool moved_to_front(const std::string& key)
    {
        auto entry = m_entries.begin();
        while (entry != m_entries.end() && entry->key != key)
            ++entry;
        if (entry == m_entries.end())
            return false;
        m_entries.splice(m_entries.begin(), m_entries, entry);
        return true;
    }

    static Pointer made(const Entry& entry)
    {
        const bool ready = entry.result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        return ready ? *entry.result.get() : Pointer{};
    }

    void add(const std::string& key, std::promise<Result>& promise)
    {
        m_entries.push_front({ key, promise.get_future().share() });
        if (m_entries.size() > m_most)
            m_entries.pop_back();
    }

    /// What is still being made. One that was kept meanwhile stays.
    void forget(const std::string& key)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_entries.remove_if([&](const Entry& entry) { return entry.key == key && !made(entry); });
    }

    std::mutex m_mutex;
    std::size_t m_most;
    std::list<Entry> m_entries; ///< the one used last first
};

} // namespace srisp
