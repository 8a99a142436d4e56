// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisppack/unmasked_part.h"

#include <string>

#include <doctest/doctest.h>

using namespace srisp;
using namespace srisp::tool;

namespace {

constexpr int kWidth = 12, kHeight = 10;

/// The part that is left of an image of ones with these pixels zero, as "x0 x1 y0 y1".
std::string part_without(const std::vector<Roi>& zeros)
{
    std::vector<float> rgb(kWidth * kHeight * 3, 1.0f);
    for (const Roi& zero : zeros)
        for (int y = zero.y0; y < zero.y1; ++y)
            for (int i = zero.x0 * 3; i < zero.x1 * 3; ++i)
                rgb[std::size_t(y * kWidth * 3 + i)] = 0;
    const Roi part = largest_unmasked_part(rgb, kWidth, kHeight);
    return std::to_string(part.x0) + " " + std::to_string(part.x1) + " " + std::to_string(part.y0) + " " +
           std::to_string(part.y1);
}

} // namespace

TEST_CASE("an image without masks is taken whole, dark pixels or not")
{
    CHECK(part_without({}) == "0 12 0 10");
    CHECK(part_without({ { 3, 4, 3, 4 }, { 7, 9, 0, 10 } }) == "0 12 0 10");
}

TEST_CASE("the largest rectangle beside a masked one is taken")
{
    CHECK(part_without({ { 9, 12, 6, 10 } }) == "0 9 0 10");
    CHECK(part_without({ { 0, 12, 0, 3 } }) == "0 12 3 10");
    CHECK(part_without({ { 4, 7, 2, 5 } }) == "0 12 5 10");
    CHECK(part_without({ { 0, 12, 0, 10 } }) == "0 0 0 0");
}
