// SPDX-License-Identifier: Apache-2.0
#include "score_words.h"

#include <algorithm>

namespace srisp::tool {

std::string counted(int count, const std::string& noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string padded_title(const Metric& metric)
{
    constexpr std::size_t kWidth = 20;
    std::string title = metric.title;
    if (*metric.unit)
        title += std::string(", ") + metric.unit;
    // ° and Δ are two bytes long in UTF-8.
    const auto more = std::count_if(title.begin(), title.end(), [](char c) { return (c & 0xc0) == 0x80; });
    title.resize(std::max(title.size(), kWidth + std::size_t(more)), ' ');
    return title;
}

} // namespace srisp::tool
