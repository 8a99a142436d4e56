// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace srisp {

/// How `count` inputs of width 1 lie on `cells` equal cells along one axis: input i touches cells first[i] …
/// first[i + 1 … ] with the lengths that they share. One table serves rows and columns.
struct AxisCoverage {
    struct Share {
        int input, cell;
        double length; ///< of the input that lies in the cell, in inputs; the shares of a cell sum to count / cells
    };
    std::vector<Share> shares;    ///< ordered by input, then by cell
    std::vector<int> first_share; ///< index of the first share of input i; count + 1 entries
};

/// Exact for any count ≥ 1, enlarging included. Computed in integers, so that shares of a cell sum exactly.
AxisCoverage axis_coverage(int count, int cells);

} // namespace srisp
