// SPDX-License-Identifier: Apache-2.0
#include "shards.h"

#include <algorithm>
#include <numeric>

#include "base/hashes.h"

namespace srisp::tool {

std::vector<std::uint64_t> assign_shards(const std::vector<ShardItem>& items, std::uint64_t count)
{
    constexpr std::uint64_t kEach = 64 * 1024; // opening, choosing and writing, as bytes of a photo
    constexpr double kMostLoad = 1.05;
    constexpr std::uint64_t kMostTries = 32;
    std::vector<std::uint64_t> shards(items.size());
    if (count < 2)
        return shards;
    std::vector<std::pair<std::uint64_t, std::size_t>> order; // by hash: who comes first does not depend on the list
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        order.emplace_back(seeded_hash(0, items[i].name), i);
        total += items[i].bytes + kEach;
    }
    std::sort(order.begin(), order.end());
    const auto most = std::uint64_t(kMostLoad * double(total) / double(count)) + 1;
    std::vector<std::uint64_t> loads(count);
    for (const auto& [hash, i] : order) {
        const std::uint64_t load = items[i].bytes + kEach;
        std::uint64_t shard = hash % count;
        for (std::uint64_t tries = 1; tries < kMostTries && loads[shard] > 0 && loads[shard] + load > most; ++tries)
            shard = seeded_hash(tries, items[i].name) % count;
        if (loads[shard] > 0 && loads[shard] + load > most)
            shard = std::uint64_t(std::min_element(loads.begin(), loads.end()) - loads.begin());
        loads[shard] += load;
        shards[i] = shard;
    }
    return shards;
}

} // namespace srisp::tool
