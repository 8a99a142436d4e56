// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispeval/bootstrap.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/random.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// One number a file, normal with this mean and deviation 1.
PerFile normal_files(std::size_t count, double mean, std::uint64_t seed)
{
    PerFile files;
    for (std::size_t i = 0; i < count; ++i)
        files.push_back({ mean + Random(seed, i).normal(), 1 });
    return files;
}

Interval mean_of(const PerFile& files)
{
    return Bootstrap(files.size(), 1).interval([&](const FileCounts& counts) { return pooled(files, counts); });
}

} // namespace

TEST_CASE("the bootstrap interval of a mean is what theory says, and the same each time")
{
    const PerFile files = normal_files(400, 5, 1);
    const Interval interval = mean_of(files);
    const double half = (interval.high - interval.low) / 2;
    CHECK(half == doctest::Approx(1.96 / std::sqrt(400.0)).epsilon(0.12));
    CHECK(interval.mean == doctest::Approx(pooled(files, FileCounts(400, 1))));
    const Interval again = mean_of(files);
    CHECK(again.low == interval.low);
    CHECK(again.high == interval.high);
}

TEST_CASE("about 95 of 100 intervals hold the true mean")
{
    int held = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Interval interval = mean_of(normal_files(40, 2, 100 + seed));
        held += interval.low <= 2 && interval.high >= 2;
    }
    CHECK(held >= 178);
    CHECK(held <= 198);
}

TEST_CASE("means pool by weight; one file has no interval, and nothing has no mean")
{
    CHECK(pooled({ { 10, 1 }, { 2, 3 } }, { 1, 1 }) == doctest::Approx(3));
    const Interval one = mean_of({ { 7, 1 } });
    CHECK(one.mean == 7);
    CHECK(std::isnan(one.low));
    CHECK(std::isnan(mean_of({ { 0, 0 }, { 0, 0 } }).mean));
}
