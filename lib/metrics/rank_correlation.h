// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace srisp {

/// Spearman's rank correlation of two lists of equal length, −1 … 1; equal values share the mean of their ranks. NaN
/// where one of the lists is constant or shorter than two.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

} // namespace srisp
