// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbatch/shards.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "base/hashes.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// Sizes as photos have them: most near one megabyte, some twenty times that.
std::vector<ShardItem> items(std::size_t first, std::size_t last)
{
    std::vector<ShardItem> result;
    for (std::size_t i = first; i < last; ++i) {
        const std::uint64_t random = seeded_hash(5, std::to_string(i));
        result.push_back(
            { std::to_string(i) + ".jpg", 200'000 + random % 1'600'000 + (random % 97 == 0) * 20'000'000 });
    }
    return result;
}

std::vector<std::uint64_t> loads(const std::vector<ShardItem>& all, std::uint64_t count)
{
    std::vector<std::uint64_t> sums(count);
    const auto shards = assign_shards(all, count);
    for (std::size_t i = 0; i < all.size(); ++i)
        sums[shards[i]] += all[i].bytes;
    return sums;
}

} // namespace

TEST_CASE("shards are of like size")
{
    for (const std::uint64_t count : { 2, 7, 64 }) {
        const auto sums = loads(items(0, 6400), count);
        const double mean = double(std::accumulate(sums.begin(), sums.end(), std::uint64_t(0))) / double(count);
        CHECK(double(*std::max_element(sums.begin(), sums.end())) < 1.07 * mean);
        CHECK(double(*std::min_element(sums.begin(), sums.end())) > 0.7 * mean);
    }
}

TEST_CASE("few items move when others come, and none by their order")
{
    const auto before = items(0, 6000), after = items(0, 6060);
    const auto old_shards = assign_shards(before, 16), new_shards = assign_shards(after, 16);
    int moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        moved += old_shards[i] != new_shards[i];
    CHECK(moved < 180); // 3 %, of 1 % that came; anew they would be 94 %
    auto reversed = before;
    std::reverse(reversed.begin(), reversed.end());
    auto shards = assign_shards(reversed, 16);
    std::reverse(shards.begin(), shards.end());
    CHECK(shards == old_shards);
}

TEST_CASE("more shards than items, and one item that is larger than all others")
{
    CHECK(assign_shards({}, 3).empty());
    CHECK(assign_shards({ { "a", 1 } }, 1) == std::vector<std::uint64_t>{ 0 });
    CHECK(assign_shards({ { "a", 1 } }, 900)[0] < 900);
    auto all = items(0, 50);
    all.push_back({ "huge", std::uint64_t(1) << 40 });
    const auto shards = assign_shards(all, 4);
    CHECK(std::count(shards.begin(), shards.end(), shards.back()) >= 1);
}
