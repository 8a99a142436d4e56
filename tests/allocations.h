// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>
#include <type_traits>

#include <doctest/doctest.h>
#include <srisp/expected.h>

// Counts what operator new is asked for, and lets one request fail. Sanitizers bring an operator new of their own.
#ifdef SRISP_SANITIZED
#define SRISP_COUNTS_ALLOCATIONS 0
#else
#define SRISP_COUNTS_ALLOCATIONS 1

namespace allocations {

extern std::atomic<long> count;              ///< of requests of `least_bytes` and more
extern std::atomic<long> failing;            ///< the request that fails: the one that makes `count` this
extern std::atomic<std::size_t> least_bytes; ///< smaller requests neither count nor fail
extern std::atomic<long> live;               ///< pieces that nobody has given back yet

/// Adds to what the program prints at its end: `allocations failed: 812, told: 800, calls: 12`.
void add_to_summary(long failed, long told);

/// Runs `step` with request number `request` failing; 0: none.
template<class Step> auto run_failing(long request, const Step& step)
{
    count = 0;
    failing = request > 0 ? request : -1;
    auto result = step();
    failing = -1;
    return result;
}

/// Whether each run of `step` with this request failing leaves memory behind. Errors of libraries may keep their text
/// for ever, and caches fill: so good runs come between, and are to leave nothing.
template<class Step> bool leaks(long request, const Step& step)
{
    const auto after = [&](long failed) {
        static_cast<void>(run_failing(failed, step));
        static_cast<void>(run_failing(0, step));
        return live.load();
    };
    after(request);
    const long first = after(0), second = after(request), third = after(0), fourth = after(request);
    return second > first && third == second && fourth - third == second - first;
}

/// Runs `step` (which gives an Expected) once, and then again and again, each time with another of its requests
/// failing: with some sixty spread over them, or where SRISP_ALLOCATIONS is "all" with each. What it gives is an error
/// that says so, or the same to the bit; nothing is left behind. `least`: libraries that get no small piece of memory
/// end the process by themselves.
template<class Step> void fail_each(std::size_t least, const Step& step)
{
    const char* const wanted = std::getenv("SRISP_ALLOCATIONS");
    const long most_runs = wanted && std::string(wanted) == "all" ? 1 << 30 : 60;
    least_bytes = least;
    static_cast<void>(run_failing(0, step)); // fills caches
    const auto expected = run_failing(0, step);
    REQUIRE_MESSAGE(expected, (expected ? "" : expected.error().message));
    const long requests = count;
    CHECK(requests > 0);
    long failed = 0, told = 0;
    for (long request = 1; request <= requests; request += std::max(requests / most_runs, 1l), ++failed) {
        const long before = live;
        bool is_told = false;
        {
            const auto result = run_failing(request, step);
            CAPTURE(request);
            is_told = !result;
            if (result) {
                CHECK(*result == *expected);
            } else {
                CAPTURE(result.error().message);
                CHECK(result.error().message.find("not enough memory") != std::string::npos);
            }
        }
        told += is_told;
        if (live > before && leaks(request, step) && leaks(request, step)) // threads end when they like
            FAIL_CHECK("memory is left behind where request " << request << " of " << requests << " fails");
    }
    CHECK(told > 0);
    add_to_summary(failed, told);
    least_bytes = 0;
}

/// For functions that give plain values, and so have no other way to say it than std::bad_alloc.
template<class Function> auto value_or_error(const Function& function)
    -> srisp::Expected<std::decay_t<decltype(function())>>
{
    try {
        return function();
    } catch (const std::bad_alloc&) {
        return srisp::Error{ "not enough memory" };
    }
}

} // namespace allocations

#endif
