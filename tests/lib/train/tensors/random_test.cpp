// SPDX-License-Identifier: Apache-2.0
#include "train/tensors/random.h"

#include <cmath>

#include <doctest/doctest.h>

#include "lib/train/small_pack.h"

using namespace srisp::train;

TEST_CASE("random numbers are those of SplitMix64")
{
    // The first output for state 0 that is published with the algorithm; seed, stream and index pass through the same
    // mixing.
    constexpr std::uint64_t kPublishedFirstOutput = 0xe220a8397b1dcdaf;
    const auto mix = [](std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    };
    CHECK(mix(0x9e3779b97f4a7c15) == kPublishedFirstOutput);
    CHECK(Random(0).bits() == mix(mix(mix(kPublishedFirstOutput)) + 0x9e3779b97f4a7c15));
}

TEST_CASE("seed, stream and index each give other random numbers, and the same ones every time")
{
    const auto first = Random(1, 2, 3).bits();
    CHECK(first == Random(1, 2, 3).bits());
    CHECK(first != Random(2, 2, 3).bits());
    CHECK(first != Random(1, 3, 3).bits());
    CHECK(first != Random(1, 2, 4).bits());
    CHECK(Random(1, 2, 3).bits() != Random(3, 2, 1).bits());
    CHECK(Random(1).fork(1).bits() != Random(1).fork(2).bits());
}

TEST_CASE("neighbouring streams and indices are not correlated")
{
    double sum = 0, sum_of_squares = 0, along = 0, previous = 0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
        const double value = Random(7, i / 100, i % 100).uniform() - 0.5;
        sum += value;
        sum_of_squares += value * value;
        along += value * previous;
        previous = value;
    }
    // Standard errors of the three: 0.002, 0.0005, 0.0006.
    CHECK(std::abs(sum / count) < 0.008);
    CHECK(std::abs(sum_of_squares / count - 1.0 / 12) < 0.002);
    CHECK(std::abs(along / count) < 0.0025);
}

TEST_CASE(
    "normal numbers have mean 0 and deviation 1, integers stay below their count, chances come true as often as said")
{
    Random random(5);
    double sum = 0, squares = 0;
    int most = 0, least = 99, hits = 0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
        const double value = random.normal();
        sum += value;
        squares += value * value;
        const int integer = static_cast<int>(random.integer(7));
        most = std::max(most, integer);
        least = std::min(least, integer);
        hits += random.chance(0.3);
    }
    CHECK(std::abs(sum / count) < 0.03);
    CHECK(std::abs(squares / count - 1) < 0.04);
    CHECK(least == 0);
    CHECK(most == 6);
    CHECK(std::abs(hits / double(count) - 0.3) < 0.013);
}

TEST_CASE("noise has mean 0, deviation 1, and belongs to its image")
{
    auto all = randoms(4, 1);
    const auto values = noise(all, { 3, 50, 50 });
    // Standard errors: 0.0058 and 0.004.
    CHECK(std::abs(values.mean().item<double>()) < 0.02);
    CHECK(std::abs(values.std().item<double>() - 1) < 0.02);
    CHECK(values.abs().max().item<double>() <= 3.4642);
    Randoms third = { randoms(4, 1)[2] };
    CHECK(torch::equal(noise(third, { 3, 50, 50 })[0], values[2]));
}
