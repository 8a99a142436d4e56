// SPDX-License-Identifier: Apache-2.0
#include "../../../../tools/srispeval/report/chart_parts.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace srisp::tool;

TEST_CASE("axes have round numbers within their range")
{
    const std::vector<double> steps = round_steps(-0.12, 0.31, 5);
    REQUIRE(steps.size() == 5);
    CHECK(steps.front() == doctest::Approx(-0.1));
    CHECK(steps.back() == doctest::Approx(0.3));
    CHECK(digits_of_steps(steps) == 1);
    CHECK(digits_of_steps(round_steps(20, 40, 5)) == 0);
    CHECK(round_steps(1, 1, 5).empty());
    CHECK(round_steps(0, std::numeric_limits<double>::infinity(), 5).empty());
    for (const double size : { 1e-6, 0.003, 1.0, 7.0, 1e7 })
        CHECK(round_steps(-size, size, 6).size() <= 8);
}

TEST_CASE("a range of one value is widened, so that nothing is divided by 0")
{
    for (const double value : { 0.0, 3.0, -1e9 }) {
        const auto [low, high] = padded(value, value);
        CHECK(low < value);
        CHECK(high > value);
    }
}

TEST_CASE("methods have shapes and classes of their own, and a seventh begins again")
{
    for (std::size_t a = 0; a < 6; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            CHECK(marker(a, 1, 2) != marker(b, 1, 2));
            CHECK(method_class(a) != method_class(b));
        }
    CHECK(method_class(6) == "m0");
}
