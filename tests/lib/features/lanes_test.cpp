// SPDX-License-Identifier: Apache-2.0
#include "features/lanes.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("logarithms and exponentials of eight numbers at once are those of the library")
{
    double log_error = 0, exp_error = 0;
    for (int i = 0; i < 4000; ++i) {
        float values[kLanes], exponents[kLanes], logs[kLanes], powers[kLanes];
        for (int k = 0; k < kLanes; ++k) {
            exponents[k] = -87 + 175 * static_cast<float>(i * kLanes + k) / 32000;
            values[k] = std::exp(exponents[k]);
        }
        Lanes v, e;
        load(values, v);
        load(exponents, e);
        take_log(v);
        take_exp(e);
        store(v, logs);
        store(e, powers);
        for (int k = 0; k < kLanes; ++k) {
            const double exact = std::log(double(values[k]));
            log_error = std::max(log_error, std::fabs(logs[k] - exact) / std::max(1.0, std::fabs(exact)));
            exp_error = std::max(exp_error, std::fabs(powers[k] / std::exp(double(exponents[k])) - 1));
        }
    }
    CHECK(log_error < 2e-7);
    CHECK(exp_error < 2e-7);
}

TEST_CASE("beyond their range, exponentials stay as at its ends, and logarithms of 1 are 0")
{
    float values[kLanes] = { 1, 1, 1, 1, 1, 1, 1, 1 }, ends[kLanes] = { -1e30f, -100, -87, 88, 100, 1e30f, 0, 1 };
    Lanes v, e;
    load(values, v);
    load(ends, e);
    take_log(v);
    take_exp(e);
    CHECK(v[0] == 0);
    CHECK(v[7] == 0);
    CHECK(e[0] == e[2]);
    CHECK(e[1] == e[2]);
    CHECK(e[4] == e[3]);
    CHECK(e[5] == e[3]);
    CHECK(std::isfinite(e[5]));
    CHECK(e[6] == 1);
}
