// SPDX-License-Identifier: Apache-2.0
#include "near_names.h"

#include <algorithm>
#include <numeric>

namespace srisp {

/// Levenshtein distance.
static std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({ row[j] + 1, row[j - 1] + 1, substituted });
        }
    }
    return row[b.size()];
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
