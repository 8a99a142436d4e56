// SPDX-License-Identifier: Apache-2.0
#include "unlocked.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <OpenEXR/ImfThreading.h>

namespace srisp::python {

namespace {

struct Gate {
    std::mutex mutex;
    std::condition_variable changed;
    int active = 0;
    bool closed = false;
    std::atomic<bool> ending{ false };
    std::thread::id last; ///< the thread that ends the interpreter

    bool stops_here() const { return ending && std::this_thread::get_id() != last; }
};

// Never destroyed: threads may still be at work while statics end.
Gate* gate = new Gate;
thread_local int active_here = 0; // a signal's handler, within a call, may fork, too
int exr_threads = 0;

/// OpenEXR reads with threads of its own, which a child would wait for: there are none during the fork.
void before_fork()
{
    const py::gil_scoped_release released;
    std::unique_lock lock(gate->mutex);
    gate->changed.wait(lock, [] { return !gate->closed; });
    gate->closed = true;
    gate->changed.wait(lock, [] { return gate->active == active_here; });
    exr_threads = Imf::globalThreadCount();
    Imf::setGlobalThreadCount(0);
}

void after_fork_in_parent()
{
    if (exr_threads > 0)
        Imf::setGlobalThreadCount(exr_threads);
    const std::lock_guard lock(gate->mutex);
    gate->closed = false;
    gate->changed.notify_all();
}

void after_fork_in_child()
{
    gate = new Gate; // who waited at the old one is not here
    gate->active = active_here;
}

/// Calls are cancelled; what cannot be, decoding, gets some time.
void before_end()
{
    const py::gil_scoped_release released;
    std::unique_lock lock(gate->mutex);
    gate->last = std::this_thread::get_id();
    gate->ending = true;
    gate->changed.wait_for(lock, std::chrono::seconds(10), [] { return gate->active == active_here; });
}

[[noreturn]] void stop_for_ever()
{
    while (true)
        std::this_thread::sleep_for(std::chrono::hours(1));
}

} // namespace

bool is_ending()
{
    return gate->stops_here();
}

Unlocked::Work::Work()
{
    std::unique_lock lock(gate->mutex);
    gate->changed.wait(lock, [] { return !gate->closed; });
    if (gate->stops_here()) {
        lock.unlock();
        stop_for_ever();
    }
    ++gate->active;
    ++active_here;
}

Unlocked::Work::~Work()
{
    {
        const std::lock_guard lock(gate->mutex);
        --gate->active;
        --active_here;
        gate->changed.notify_all();
    }
    if (gate->stops_here())
        stop_for_ever();
}

BackgroundWork::BackgroundWork()
{
    const std::lock_guard lock(gate->mutex);
    ++gate->active;
}

BackgroundWork::~BackgroundWork()
{
    const std::lock_guard lock(gate->mutex);
    --gate->active;
    gate->changed.notify_all();
}

void watch_interpreter()
{
    using namespace py::literals;
    py::module_::import("os").attr("register_at_fork")("before"_a = py::cpp_function(&before_fork),
                                                       "after_in_parent"_a = py::cpp_function(&after_fork_in_parent),
                                                       "after_in_child"_a = py::cpp_function(&after_fork_in_child));
    py::module_::import("atexit").attr("register")(py::cpp_function(&before_end));
}

} // namespace srisp::python
