// SPDX-License-Identifier: Apache-2.0
#include "unlocked.h"

#include <condition_variable>
#include <mutex>

#include <OpenEXR/ImfThreading.h>

namespace srisp::python {

namespace {

struct Gate {
    std::mutex mutex;
    std::condition_variable changed;
    int active = 0;
    bool closed = false;
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

} // namespace

Unlocked::Work::Work()
{
    std::unique_lock lock(gate->mutex);
    gate->changed.wait(lock, [] { return !gate->closed; });
    ++gate->active;
    ++active_here;
}

Unlocked::Work::~Work()
{
    const std::lock_guard lock(gate->mutex);
    --gate->active;
    --active_here;
    gate->changed.notify_all();
}

void hold_forks()
{
    using namespace py::literals;
    py::module_::import("os").attr("register_at_fork")("before"_a = py::cpp_function(&before_fork),
                                                       "after_in_parent"_a = py::cpp_function(&after_fork_in_parent),
                                                       "after_in_child"_a = py::cpp_function(&after_fork_in_child));
}

} // namespace srisp::python
