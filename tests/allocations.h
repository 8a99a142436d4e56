// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <string>

#include <doctest/doctest.h>

// Counts what operator new is asked for, and lets one request fail. Sanitizers bring an operator new of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SRISP_COUNTS_ALLOCATIONS 0
#else
#define SRISP_COUNTS_ALLOCATIONS 1

namespace allocations {

extern std::atomic<long> count;              ///< of requests of `least_bytes` and more
extern std::atomic<long> failing;            ///< the request that fails: the one that makes `count` this
extern std::atomic<std::size_t> least_bytes; ///< smaller requests neither count nor fail

/// Runs `step` (which gives an Expected) once, and then again and again, each time with another of its requests
/// failing: with all in turn, or with some sixty spread over them. What it gives is an error that says so, or the
/// same to the bit. `least`: libraries that get no small piece of memory end the process by themselves.
template<class Step> void fail_each(std::size_t least, const Step& step)
{
    constexpr long kMostRuns = 60, kNone = -1;
    least_bytes = least;
    count = 0;
    const auto expected = step();
    REQUIRE_MESSAGE(expected, (expected ? "" : expected.error().message));
    const long requests = count;
    CHECK(requests > 0);
    long errors = 0;
    for (long request = 1; request <= requests; request += std::max(requests / kMostRuns, 1l)) {
        count = 0;
        failing = request;
        const auto result = step();
        failing = kNone;
        CAPTURE(request);
        if (result) {
            CHECK(*result == *expected);
        } else {
            ++errors;
            CAPTURE(result.error().message);
            CHECK(result.error().message.find("not enough memory") != std::string::npos);
        }
    }
    CHECK(errors > 0);
    least_bytes = 0;
}

} // namespace allocations

#endif
