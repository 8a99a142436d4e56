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
    Quantiles of_five({ 5, 1, 3, 2, 4 });
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
    Quantiles quantile(values);
    for (std::size_t i = 0; i < sorted.size(); i += 10)
        CHECK(quantile(i / 4096.0) == sorted[i]);
}

TEST_CASE("quantiles of ties, of one value many times and of few far from the rest are those of sorted values")
{
    Random random(6);
    std::vector<float> ties, close{ -1e30f, 1e30f };
    for (int i = 0; i < 4096; ++i) {
        ties.push_back(std::floor(random.uniform(-3, 3)) / 2);
        close.push_back(1 + random.uniform(0, 1e-5f)); // all in one range
    }
    for (const std::vector<float>& values : { ties, close, std::vector<float>(1000, 0.25f), { 2, 1 } }) {
        std::vector<float> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        Quantiles quantile(values);
        const double last = static_cast<double>(sorted.size() - 1);
        for (const double q : { 0.0, 0.02, 0.5, 0.995, 1.0, 0.25 }) { // in no order, as ranges are sorted when needed
            const auto below = static_cast<std::size_t>(q * last);
            const double next = sorted[std::min(below + 1, sorted.size() - 1)];
            CHECK(quantile(q) == sorted[below] + (q * last - below) * (next - sorted[below]));
        }
    }
}

TEST_CASE("quantiles of colours are those of the ratios' logarithms, whatever the number of pixels")
{
    constexpr std::size_t kPixels = 21; // no multiple of what is computed at once
    ReducedImage image;
    Random random(7);
    for (std::vector<float>& channel : image)
        for (std::size_t i = 0; i < kPixels; ++i)
            channel.push_back(random.uniform(0.001f, 1));
    std::vector<double> ratios;
    for (std::size_t i = 0; i < kPixels; ++i)
        ratios.push_back(std::log((image[0][i] + 0.002) / (image[1][i] + 0.002)));
    std::sort(ratios.begin(), ratios.end());
    constexpr int kRedOverGreen = 43, kMedian = 3; // after 4 × 10 quantiles and 3 shares
    CHECK(quantile_features(image)[kRedOverGreen + kMedian] == doctest::Approx(ratios[kPixels / 2]).epsilon(1e-6));
}
