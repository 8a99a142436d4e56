// SPDX-License-Identifier: Apache-2.0
#include "base/near_names.h"

#include <algorithm>

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

std::string near_names(const std::string& name, const std::vector<std::string>& known)
{
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& candidate : known) {
        // A third of the letters may be wrong: catches slips without offering names that only have the same length.
        const std::size_t distance = edit_distance(name, candidate);
        if (distance <= std::max<std::size_t>(1, std::max(name.size(), candidate.size()) / 3))
            near.emplace_back(distance, candidate);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min<std::size_t>(near.size(), 3));
    std::string text;
    if (!near.empty()) {
        for (const auto& [distance, candidate] : near)
            text += (text.empty() ? "; did you mean '" : " or '") + candidate + "'";
        return text + "?";
    }
    for (const std::string& candidate : known)
        text += (text.empty() ? "; known: " : ", ") + candidate;
    return text;
}

} // namespace srisp
