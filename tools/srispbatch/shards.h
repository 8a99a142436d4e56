// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace srisp::tool {

/// What goes into one shard together: a photo, or a shot.
struct ShardItem {
    std::string name;
    std::uint64_t bytes; ///< how much work it is
};

/// The shard of each item, by consistent hashing with bounded loads: an item's name says which shards it prefers, and
/// it goes to the first that is not full, at 5 % above the mean. So shards are of like size, and few items move when
/// others come. [Mirrokni, Thorup, Zadimoghaddam 2018]
std::vector<std::uint64_t> assign_shards(const std::vector<ShardItem>& items, std::uint64_t count);

} // namespace srisp::tool
