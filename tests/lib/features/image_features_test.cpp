// SPDX-License-Identifier: Apache-2.0
#include "features/image_features.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "random_model.h"

using namespace srisp;

TEST_CASE("quantiles interpolate linearly, and the median of an even count is the mean of the middle two")
{
    CHECK(Quantiles({ 4, 1, 3, 2 })(0.5) == 2.5);
    const Quantiles of_five({ 5, 1, 3, 2, 4 });
    CHECK(of_five(1) == 5);
    CHECK(of_five(0) == 1);
    CHECK(of_five(0.5) == 3);
    CHECK(of_five(0.98) == doctest::Approx(4.92));
    CHECK(Quantiles({ 7 })(0.98) == 7);
}

TEST_CASE("quantiles find every rank, of values of both signs and of all sizes")
{
    Random random(5);
    std::vector<float> values{ 0, -0.0f, 1, 1, 1e-40f, -1e-40f, 3e38f, -3e38f };
    while (values.size() < 4097)
        values.push_back(random.uniform(-1, 1) * std::pow(10.0f, random.uniform(-20, 20)));
    std::vector<float> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const Quantiles quantile(values);
    for (std::size_t i = 0; i < sorted.size(); i += 10)
        CHECK(quantile(i / 4096.0) == sorted[i]);
}
