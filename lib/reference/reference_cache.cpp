// SPDX-License-Identifier: Apache-2.0
#include <srisp/reference.h>

#include <cstdio>
#include <future>
#include <list>
#include <mutex>

#include <sys/stat.h>

namespace srisp {

namespace {

using Result = Expected<std::shared_ptr<const Reference>>;

constexpr std::size_t kMostEntries = 64; // 0.8 MB each

/// One file in one state; "" if there is no such file.
std::string key_of(const std::string& path)
{
    struct stat status;
    if (::stat(path.c_str(), &status) != 0)
        return {};
    char state[128];
    std::snprintf(state, sizeof state, "\n%llu %llu %lld %lld %ld", static_cast<unsigned long long>(status.st_dev),
                  static_cast<unsigned long long>(status.st_ino), static_cast<long long>(status.st_size),
                  static_cast<long long>(status.st_mtim.tv_sec), status.st_mtim.tv_nsec);
    return path + state;
}

/// The references that were used last, newest first. Requests for one that is being loaded wait for it.
class Cache {
public:
    Result get(const std::string& path, const std::string& key)
    {
        std::promise<Result> promise;
        std::shared_future<Result> future;
        {
            const std::lock_guard<std::mutex> lock(m_mutex);
            if (const auto found = find(key); found != m_entries.end()) {
                m_entries.splice(m_entries.begin(), m_entries, found);
                future = found->result;
            } else {
                m_entries.push_front({ key, promise.get_future().share() });
                if (m_entries.size() > kMostEntries)
                    m_entries.pop_back();
            }
        }
        if (future.valid())
            return future.get();
        Result result = load_reference(path);
        promise.set_value(result);
        if (!result)
            forget(key); // what failed for want of memory may work next time
        return result;
    }

private:
    struct Entry {
        std::string key;
        std::shared_future<Result> result;
    };

    std::list<Entry>::iterator find(const std::string& key)
    {
        auto entry = m_entries.begin();
        while (entry != m_entries.end() && entry->key != key)
            ++entry;
        return entry;
    }

    void forget(const std::string& key)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (const auto found = find(key); found != m_entries.end())
            m_entries.erase(found);
    }

    std::mutex m_mutex;
    std::list<Entry> m_entries;
};

} // namespace

Result load_reference_cached(const std::string& path)
{
    // Never destroyed: other threads of the host may still read while statics end.
    static Cache& cache = *new Cache;
    try {
        const std::string key = key_of(path);
        return key.empty() ? load_reference(path) : cache.get(path, key);
    } catch (const std::exception& failed) {
        return Error{ "reference '" + path + "': " + failed.what() };
    }
}

} // namespace srisp
