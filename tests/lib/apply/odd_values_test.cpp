// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <utility>

#include "apply_fixture.h"
#include "each_target.h"

using namespace srisp;

TEST_CASE("of values outside 0 to 1, and of what is no number, results are those of 0 and 1, neighbours included")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::pair<float, float> odd_and_counted[] = {
        { nan, 0 }, { infinity, 1 }, { -infinity, 0 }, { -1, 0 }, { 65504, 1 }, { 70000, 1 }, { 3e38f, 1 },
    };
    for (const int kernel_size : { 1, 3 }) {
        Fixture fixture(kernel_size);
        for (const Direction direction : { Direction::reverse, Direction::forward })
            on_each_instruction_set([&] {
                for (const Precision precision : { Precision::float32, Precision::fast }) {
                    const auto applier = fixture.applier(direction, precision);
                    for (const auto& [odd, counted] : odd_and_counted) {
                        CAPTURE(odd);
                        CAPTURE(kernel_size);
                        Image with_odd = random_image(19, 21);
                        with_odd.values[3 * (19 * 10 + 9) + 1] = odd;
                        Image with_counted = with_odd;
                        with_counted.values[3 * (19 * 10 + 9) + 1] = counted;
                        const Image result = applied(*applier, with_odd);
                        CHECK(result.values == applied(*applier, with_counted).values);
                        CHECK(std::all_of(result.values.begin(), result.values.end(),
                                          [](float value) { return value >= 0 && value <= 1; }));
                    }
                    Image tiny = random_image(19, 21);
                    for (float& value : tiny.values)
                        value *= 1e-39f;
                    const Image result = applied(*applier, tiny);
                    CHECK(std::all_of(result.values.begin(), result.values.end(),
                                      [](float value) { return value >= 0 && value <= 1; }));
                }
            });
    }
}
