// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace srisp::train {

/// `count` of the indices 0 … total − 1, or all of them, evenly spread.
inline std::vector<std::size_t> evenly_spread(std::size_t total, std::size_t count)
{
    count = std::min(count, total);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back((2 * i + 1) * total / (2 * count));
    return chosen;
}

} // namespace srisp::train
