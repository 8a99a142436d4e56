// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

/// How far two images or tensors are apart, for a test to judge; `text` says where the largest difference is.
struct Difference {
    double largest = 0;          ///< of |a − b|
    double largest_relative = 0; ///< of |a − b| / max(1, |b|)
    double percentile_99_9 = 0;  ///< of |a − b|
    std::string text;
};

/// `expected` may be any container of numbers; NaN counts as an infinite difference.
template<class Actual, class Expected> Difference compare(const Actual& actual, const Expected& expected)
{
    Difference difference;
    if (actual.size() != expected.size() || actual.size() == 0) {
        difference.largest = difference.largest_relative = difference.percentile_99_9 = INFINITY;
        difference.text = std::to_string(actual.size()) + " values against " + std::to_string(expected.size());
        return difference;
    }
    std::vector<double> all;
    std::size_t where = 0;
    for (std::size_t i = 0; i < actual.size(); ++i) {
        double d = std::abs(static_cast<double>(actual[i]) - static_cast<double>(expected[i]));
        if (std::isnan(d))
            d = INFINITY;
        if (d > difference.largest) {
            difference.largest = d;
            where = i;
        }
        const double relative = d / std::max(1.0, std::abs(static_cast<double>(expected[i])));
        difference.largest_relative = std::max(difference.largest_relative, relative);
        all.push_back(d);
    }
    const auto nth = all.begin() + static_cast<std::ptrdiff_t>(0.999 * (all.size() - 1));
    std::nth_element(all.begin(), nth, all.end());
    difference.percentile_99_9 = *nth;
    char text[160];
    std::snprintf(text, sizeof text, "largest difference %.3g at element %zu of %zu (%.9g against %.9g), 99.9 %%: %.3g",
                  difference.largest, where, actual.size(), static_cast<double>(actual[where]),
                  static_cast<double>(expected[where]), difference.percentile_99_9);
    difference.text = text;
    return difference;
}
