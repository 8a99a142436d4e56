// SPDX-License-Identifier: Apache-2.0
#include "train/tensors/color.h"

#include <doctest/doctest.h>

using namespace srisp::train;

TEST_CASE("quantiles are values of their rank")
{
    torch::manual_seed(1);
    const auto rows = torch::rand({ 5, 101 });
    const auto sorted = std::get<0>(rows.sort(1));
    const auto quantiles = row_quantiles(rows, { 0, 0.05, 0.5, 0.97, 1 });
    int i = 0;
    for (const int rank : { 0, 5, 50, 97, 100 })
        CHECK(torch::equal(quantiles[i++], sorted.select(1, rank)));
    CHECK(torch::equal(row_quantile(rows, 0.97), sorted.select(1, 97)));
}
