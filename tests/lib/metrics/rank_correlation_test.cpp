// SPDX-License-Identifier: Apache-2.0
#include "metrics/rank_correlation.h"

#include <cmath>

#include <doctest/doctest.h>

using srisp::rank_correlation;

TEST_CASE("the rank correlation asks for the order alone")
{
    CHECK(rank_correlation({ 1, 2, 3, 4 }, { 10, 11, 500, 501 }) == doctest::Approx(1));
    CHECK(rank_correlation({ 1, 2, 3, 4 }, { 4, 3, 2, 1 }) == doctest::Approx(-1));
    // One exchange of neighbours among four: 1 − 6 · 2 / (4 · 15).
    CHECK(rank_correlation({ 1, 2, 3, 4 }, { 1, 3, 2, 4 }) == doctest::Approx(0.8));
}

TEST_CASE("equal values share their rank, and a list without any order has no correlation")
{
    CHECK(rank_correlation({ 1, 2, 2, 3 }, { 1, 2, 2, 3 }) == doctest::Approx(1));
    CHECK(rank_correlation({ 1, 2, 2, 3 }, { 1, 2, 3, 4 }) == doctest::Approx(4.5 / std::sqrt(4.5 * 5)));
    CHECK(std::isnan(rank_correlation({ 1, 1, 1 }, { 1, 2, 3 })));
    CHECK(std::isnan(rank_correlation({ 1 }, { 1 })));
}
