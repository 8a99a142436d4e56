// SPDX-License-Identifier: Apache-2.0
#include "base/near_names.h"

#include <algorithm>

#include "base/shown_text.h"

namespace srisp {

/// Letters inserted, left out, replaced or swapped with their neighbour (Damerau, each place edited once).
static std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({ d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]) });
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

/// A third of the letters may be wrong: catches slips without offering names that only have the same length.
static std::size_t most_edits(const std::string& a, const std::string& b)
{
    return std::max<std::size_t>(1, std::max(a.size(), b.size()) / 3);
}

std::string near_names(const std::string& name, const std::vector<std::string>& known)
{
    // Names of ours are far below; those of strangers, such as columns of a table, may be of any length and number.
    constexpr std::size_t kLongestName = 100, kMostCompared = 1000, kMostListed = 64;
    const std::size_t compared = std::min(known.size(), kMostCompared);
    std::vector<std::pair<std::size_t, std::string>> near;
    for (std::size_t i = 0; i < compared && name.size() <= kLongestName; ++i) {
        const std::string& candidate = known[i];
        if (candidate.size() > kLongestName)
            continue;
        const std::size_t distance = edit_distance(name, candidate);
        if (distance <= most_edits(name, candidate))
            near.emplace_back(distance, candidate);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min<std::size_t>(near.size(), 3));
    std::string text;
    if (!near.empty()) {
        for (const auto& [distance, candidate] : near)
            text += (text.empty() ? "; did you mean '" : " or '") + shown_text(candidate) + "'";
        return text + "?";
    }
    const std::size_t listed = std::min(known.size(), kMostListed);
    for (std::size_t i = 0; i < listed; ++i)
        text += (text.empty() ? "; known: " : ", ") + shown_text(known[i]);
    return listed < known.size() ? text + ", and " + std::to_string(known.size() - listed) + " more" : text;
}

} // namespace srisp
