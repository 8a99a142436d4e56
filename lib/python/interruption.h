// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include "unlocked.h"

// Ctrl-C while the library works without the interpreter's lock.

namespace srisp::python {

/// To be asked by the thread that works for the interpreter; takes the lock for it now and then.
class Interruption {
public:
    bool pending()
    {
        if (is_ending())
            return true;
        const auto now = Clock::now();
        if (m_raised || now - m_last < std::chrono::milliseconds(50))
            return bool(m_raised);
        m_last = now;
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0)
            m_raised = std::make_exception_ptr(py::error_already_set());
        return bool(m_raised);
    }
    /// With the lock held.
    void rethrow() const
    {
        if (m_raised)
            std::rethrow_exception(m_raised);
    }

private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point m_last = Clock::now();
    std::exception_ptr m_raised;
};

/// The result of `job`, which cannot be stopped: on a thread of its own, which is left alone when a signal comes. So
/// it owns all that it uses. To be called with the lock.
template<class Job> auto wait_for(Job job) -> decltype(job())
{
    std::packaged_task<decltype(job())()> task(std::move(job));
    auto result = task.get_future();
    Interruption interruption;
    {
        const Unlocked unlocked;
        std::thread([task = std::move(task), work = std::make_unique<BackgroundWork>()]() mutable { task(); }).detach();
        while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready && !interruption.pending())
            continue;
    }
    interruption.rethrow();
    return result.get();
}

} // namespace srisp::python
