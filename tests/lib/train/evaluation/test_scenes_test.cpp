// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/test_scenes.h"

#include <doctest/doctest.h>

using namespace srisp::train;

TEST_CASE("the half split gives the left half, and the right half's top and bottom one after the other")
{
    const auto images = torch::arange(2 * 3 * 4 * 6, torch::kFloat32).view({ 2, 3, 4, 6 });
    CHECK(torch::equal(left_halves(images), images.slice(3, 0, 3)));
    const auto quarters = right_quarters(images);
    REQUIRE(quarters.sizes() == at::IntArrayRef({ 4, 3, 2, 3 }));
    CHECK(torch::equal(quarters[0], images[0].slice(1, 0, 2).slice(2, 3, 6)));
    CHECK(torch::equal(quarters[1], images[0].slice(1, 2, 4).slice(2, 3, 6)));
    CHECK(torch::equal(quarters[2], images[1].slice(1, 0, 2).slice(2, 3, 6)));
}

TEST_CASE("of an odd width and height the middle belongs to no half")
{
    const auto images = torch::arange(3 * 5 * 7, torch::kFloat32).view({ 1, 3, 5, 7 });
    CHECK(torch::equal(left_halves(images)[0], images[0].slice(2, 0, 3)));
    CHECK(torch::equal(right_quarters(images)[0], images[0].slice(1, 0, 2).slice(2, 4, 7)));
    CHECK(torch::equal(right_quarters(images)[1], images[0].slice(1, 3, 5).slice(2, 4, 7)));
}
