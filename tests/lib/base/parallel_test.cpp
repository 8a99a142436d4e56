// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

using namespace srisp;

namespace {

/// OpenImageIO's threads, whatever the machine has; as before afterwards.
class PoolOf {
public:
    explicit PoolOf(int threads) : m_before(OIIO::get_int_attribute("threads")) { OIIO::attribute("threads", threads); }
    ~PoolOf() { OIIO::attribute("threads", m_before); }

private:
    int m_before;
};

} // namespace

TEST_CASE("each task runs once, with any number of tasks and threads")
{
    const PoolOf pool(4);
    for (const int threads : { 0, 1, 2, 3, 100 })
        for (const std::int64_t count : { 0, 1, 2, 3, 31, 32, 33, 1000 }) {
            CAPTURE(threads);
            CAPTURE(count);
            std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
            parallel_tasks(count, threads, [&](std::int64_t i) { ++runs[static_cast<std::size_t>(i)]; });
            for (const auto& each : runs)
                CHECK(each == 1);
        }
}

TEST_CASE("what a task throws reaches the caller, whichever task it was")
{
    const PoolOf pool(4);
    constexpr std::int64_t kCount = 40;
    for (const int threads : { 0, 1, 2, 4 })
        for (std::int64_t bad = 0; bad < kCount; ++bad) {
            CAPTURE(threads);
            CAPTURE(bad);
            std::string caught;
            try {
                parallel_tasks(kCount, threads, [&](std::int64_t i) {
                    if (i == bad)
                        throw std::runtime_error("task " + std::to_string(i));
                });
            } catch (const std::runtime_error& thrown) {
                caught = thrown.what();
            }
            CHECK(caught == "task " + std::to_string(bad));
        }
}

TEST_CASE("a task that fails on a thread of the pool is not lost, and no task runs on behind its back")
{
    const PoolOf pool(4);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> running{ 0 };
    const auto work = [&](std::int64_t) {
        ++running;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        --running;
        if (std::this_thread::get_id() != caller)
            throw std::bad_alloc();
    };
    CHECK_THROWS_AS(parallel_tasks(64, 0, work), std::bad_alloc);
    CHECK(running == 0);
}

TEST_CASE("tasks of tasks run, too")
{
    const PoolOf pool(4);
    std::atomic<int> sum{ 0 };
    parallel_tasks(20, 0, [&](std::int64_t) { parallel_tasks(20, 0, [&](std::int64_t) { ++sum; }); });
    CHECK(sum == 400);
}
