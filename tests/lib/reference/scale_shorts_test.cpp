// SPDX-License-Identifier: Apache-2.0
#include "reference/raw_pixels.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "each_target.h"

using namespace srisp;

TEST_CASE("samples are scaled to the same bits on every instruction set, and clipped at black and white")
{
    for (const std::size_t count : { 1, 5, 64, 101 }) {
        std::vector<std::uint16_t> source;
        std::vector<float> black, factor, expected;
        for (std::size_t i = 0; i < count; ++i) {
            source.push_back(static_cast<std::uint16_t>(i * 40503));
            black.push_back(500.25f + static_cast<float>(i % 2));
            factor.push_back(1 / (60000 - black.back()));
            expected.push_back(std::min(std::max((float(source[i]) - black[i]) * factor[i], 0.0f), 1.0f));
        }
        on_each_instruction_set([&] {
            std::vector<float> target(count + 1, -1.0f);
            scale_shorts(source.data(), black.data(), factor.data(), count, target.data());
            CHECK(target.back() == -1.0f);
            target.pop_back();
            CHECK(target == expected);
        });
    }
}
