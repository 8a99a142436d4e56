// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>

#include <OpenImageIO/thread.h>

namespace srisp {

namespace {

/// One call's tasks. Threads of the pool share it, since those that are busy elsewhere come when the call is over.
class TaskQueue {
public:
    TaskQueue(std::int64_t count, std::int64_t at_a_time, OIIO::function_view<void(std::int64_t)> task)
        : m_count(count), m_at_a_time(at_a_time), m_task(task)
    {
    }

    /// On the caller's thread. The first tasks are its own, however soon the others begin: it is the one that may ask
    /// for a break.
    void reserve_first() { m_next = m_at_a_time; }
    void work_first() { work(0); }

    void work_if_open()
    {
        {
            const std::lock_guard lock(m_mutex);
            if (m_closed)
                return;
            ++m_active;
        }
        work(m_next.fetch_add(m_at_a_time));
        const std::lock_guard lock(m_mutex);
        if (--m_active == 0)
            m_idle.notify_all();
    }

    /// Nobody begins any more, and all that began have ended.
    void close()
    {
        std::unique_lock lock(m_mutex);
        m_closed = true;
        m_idle.wait(lock, [this] { return m_active == 0; });
        if (m_thrown)
            std::rethrow_exception(m_thrown);
    }

private:
    void work(std::int64_t first)
    {
        try {
            for (; first < m_count && !m_failed; first = m_next.fetch_add(m_at_a_time))
                for (std::int64_t i = first; i < std::min(first + m_at_a_time, m_count); ++i)
                    m_task(i);
        } catch (...) {
            const std::lock_guard lock(m_mutex);
            if (!m_thrown)
                m_thrown = std::current_exception();
            m_failed = true;
        }
    }

    std::int64_t m_count, m_at_a_time;
    OIIO::function_view<void(std::int64_t)> m_task;
    std::atomic<std::int64_t> m_next{ 0 };
    std::atomic<bool> m_failed{ false };
    std::mutex m_mutex;
    std::condition_variable m_idle;
    std::exception_ptr m_thrown;
    int m_active = 0;
    bool m_closed = false;
};

/// A process that was forked later (a DataLoader's worker) has the pool, but none of its threads.
const pid_t loading_process = ::getpid();

/// How many threads take part, the caller's among them.
std::int64_t workers_for(std::int64_t count, int threads)
{
    if (count <= 1 || threads == 1 || ::getpid() != loading_process)
        return 1;
    const OIIO::thread_pool& pool = *OIIO::default_thread_pool();
    if (pool.is_worker())
        return 1; // the others have work
    const std::int64_t most = std::int64_t(pool.size()) + 1;
    return std::min({ threads > 0 ? std::int64_t(threads) : most, most, count });
}

} // namespace

void parallel_tasks(std::int64_t count, int threads, OIIO::function_view<void(std::int64_t)> task)
{
    const std::int64_t workers = workers_for(count, threads);
    if (workers <= 1) {
        for (std::int64_t i = 0; i < count; ++i)
            task(i);
        return;
    }
    constexpr std::int64_t kTurns = 8; // of each thread, for a slow one to hold nobody up
    const auto queue = std::make_shared<TaskQueue>(count, std::max<std::int64_t>(count / (workers * kTurns), 1), task);
    queue->reserve_first();
    try {
        for (std::int64_t worker = 1; worker < workers; ++worker)
            OIIO::default_thread_pool()->push([queue](int) { queue->work_if_open(); });
    } catch (const std::bad_alloc&) {
        // With fewer threads, then.
    }
    queue->work_first();
    queue->close();
}

} // namespace srisp
