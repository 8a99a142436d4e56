// SPDX-License-Identifier: Apache-2.0
#include "features/sums.h"

#include <vector>

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("sums and products take every value, however many there are")
{
    for (const std::size_t count : { 0, 1, 7, 8, 9, 31, 4096 }) {
        std::vector<float> a, b;
        double sum = 0, product = 0;
        for (std::size_t i = 0; i < count; ++i) {
            a.push_back(static_cast<float>(i % 17) - 5);
            b.push_back(0.5f * static_cast<float>(i % 5));
            sum += a[i];
            product += a[i] * b[i];
        }
        CHECK(sum_of(a.data(), count) == sum);
        CHECK(product_of(a.data(), b.data(), count) == product);
    }
}
