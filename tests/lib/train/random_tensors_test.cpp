// SPDX-License-Identifier: Apache-2.0
#include "random_tensors.h"

#include <doctest/doctest.h>

#include "small_pack.h"

using namespace srisp::train;

TEST_CASE("noise has mean 0, deviation 1, and belongs to its image")
{
    auto all = randoms(4, 1);
    const auto values = noise(all, { 3, 50, 50 });
    // Standard errors: 0.0058 and 0.004.
    CHECK(std::abs(values.mean().item<double>()) < 0.02);
    CHECK(std::abs(values.std().item<double>() - 1) < 0.02);
    CHECK(values.abs().max().item<double>() <= 3.4642);
    Randoms third = { randoms(4, 1)[2] };
    CHECK(torch::equal(noise(third, { 3, 50, 50 })[0], values[2]));
}

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
