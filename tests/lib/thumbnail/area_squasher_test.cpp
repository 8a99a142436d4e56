// SPDX-License-Identifier: Apache-2.0
#include "thumbnail/area_squasher.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace srisp;

static std::vector<float> squashed(const std::vector<float>& grey, int width, int height, int size, int orientation = 1)
{
    std::vector<float> rgb;
    for (const float value : grey)
        rgb.insert(rgb.end(), { value, value, value });
    AreaSquasher squasher(width, height, size);
    squasher.add_rows({ rgb.data(), width, height, 3, 3 * width });
    std::vector<float> result;
    const std::vector<float> three = squasher.finish(orientation);
    for (std::size_t i = 0; i < three.size(); i += 3)
        result.push_back(three[i]);
    return result;
}

TEST_CASE("an image is squashed to any size by the areas that its pixels cover, enlarging included")
{
    // 3 × 2 to 2 × 2: each cell is one and a half pixels wide.
    CHECK(squashed({ 0, 3, 6, 9, 12, 15 }, 3, 2, 2) == std::vector<float>{ 1, 5, 10, 14 });
    // 2 × 1 to 3 × 3: the middle column is half of each.
    CHECK(squashed({ 0, 6 }, 2, 1, 3) == std::vector<float>{ 0, 3, 6, 0, 3, 6, 0, 3, 6 });
    // Stored lying on its side: EXIF 6 turns it clockwise.
    CHECK(squashed({ 1, 2, 3, 4 }, 2, 2, 2, 6) == std::vector<float>{ 3, 1, 4, 2 });
}

TEST_CASE("rows may come in any portions")
{
    constexpr int width = 37, height = 53, size = 16;
    std::vector<float> rgb(std::size_t(width) * height * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        rgb[i] = float(i * 7919 % 1009) / 1009;
    const auto in_portions = [&](int rows) {
        AreaSquasher squasher(width, height, size);
        for (int y = 0; y < height; y += rows)
            squasher.add_rows(
                { rgb.data() + std::ptrdiff_t(y) * width * 3, width, std::min(rows, height - y), 3, 3 * width });
        return squasher.finish(1);
    };
    const std::vector<float> one_by_one = in_portions(1);
    for (const int rows : { 3, 4, 5, height })
        CHECK(in_portions(rows) == one_by_one);
}
