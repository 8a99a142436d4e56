// SPDX-License-Identifier: Apache-2.0
#include "dng/huffman_code.h"

#include <cmath>
#include <utility>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

/// The part of all codes that a code takes; less than 1 in sum, as that of all ones stays free.
double taken(const HuffmanCode& code)
{
    double sum = 0;
    for (std::size_t i = 0; i < code.lengths.size(); ++i)
        sum += code.lengths[i] * std::exp2(-double(i + 1));
    return sum;
}

} // namespace

TEST_CASE("A single category has a code of one bit, which is not a one")
{
    CategoryCounts counts{};
    counts[5] = 1000;
    const HuffmanCode code = fit_huffman_code(counts);
    CHECK(code.categories == std::vector<std::uint8_t>{ 5 });
    CHECK(code.bits[5] == 1);
    CHECK(code.code[5] == 0);
    CHECK(code.bits[4] == 0);
}

TEST_CASE("Frequent categories have shorter codes")
{
    CategoryCounts counts{};
    counts[0] = 1;
    counts[3] = 8;
    counts[7] = 4;
    counts[16] = 2;
    const HuffmanCode code = fit_huffman_code(counts);
    CHECK(code.categories == std::vector<std::uint8_t>{ 3, 7, 16, 0 });
    CHECK(code.bits[3] == 1);
    CHECK(code.bits[7] == 2);
    CHECK(code.bits[16] == 3);
    CHECK(code.bits[0] == 4);
    CHECK(code.code[0] == 0b1110);
}

TEST_CASE("Codes stay within 16 bits, and that of all ones stays free, whatever the counts are")
{
    CategoryCounts counts{};
    std::uint64_t a = 1, b = 1;
    for (std::uint64_t& count : counts) { // Fibonacci's numbers make the deepest trees
        count = a;
        a = std::exchange(b, a + b);
    }
    const HuffmanCode code = fit_huffman_code(counts);
    CHECK(code.categories.size() == counts.size());
    CHECK(taken(code) < 1);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        CHECK(code.bits[i] >= 1);
        CHECK(code.bits[i] <= 16);
        CHECK(code.code[i] < (1u << code.bits[i]) - 1);
    }
}
