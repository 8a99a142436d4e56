// SPDX-License-Identifier: Apache-2.0
#include "thumbnail/area_average.h"

#include <algorithm>
#include <cstdint>

namespace srisp {

AxisCoverage axis_coverage(int count, int cells)
{
    // On a grid of count × cells steps, input i spans [i·cells, (i+1)·cells) and cell j spans [j·count, (j+1)·count).
    AxisCoverage coverage;
    coverage.first_share.reserve(count + 1);
    for (std::int64_t input = 0; input < count; ++input) {
        coverage.first_share.push_back(static_cast<int>(coverage.shares.size()));
        const std::int64_t begin = input * cells, end = begin + cells;
        for (std::int64_t cell = begin / count; cell * count < end; ++cell) {
            const std::int64_t shared = std::min(end, (cell + 1) * count) - std::max(begin, cell * count);
            coverage.shares.push_back(
                { static_cast<int>(input), static_cast<int>(cell), static_cast<double>(shared) / cells });
        }
    }
    coverage.first_share.push_back(static_cast<int>(coverage.shares.size()));
    return coverage;
}

} // namespace srisp
