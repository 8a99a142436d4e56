// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <doctest/doctest.h>
#include <srisp/noise.h>

using namespace srisp;

namespace {

CameraFacts with_profile(std::vector<double> profile)
{
    CameraFacts facts;
    facts.noise_profile = std::move(profile);
    return facts;
}

} // namespace

TEST_CASE("a NoiseProfile of one pair is for all colours, one of three for each")
{
    const auto one = profile_noise(with_profile({ 1e-4, 2e-7 }));
    REQUIRE(one);
    CHECK(one->shot == std::array<double, 3>{ 1e-4, 1e-4, 1e-4 });
    CHECK(one->read == std::array<double, 3>{ 2e-7, 2e-7, 2e-7 });
    const auto three = profile_noise(with_profile({ 1e-4, 2e-7, 3e-4, 4e-7, 5e-4, 6e-7 }));
    REQUIRE(three);
    CHECK(three->shot == std::array<double, 3>{ 1e-4, 3e-4, 5e-4 });
    CHECK(three->read == std::array<double, 3>{ 2e-7, 4e-7, 6e-7 });
}

TEST_CASE("a NoiseProfile that is missing or cannot be is refused")
{
    const auto refusal = [](std::vector<double> profile) {
        return profile_noise(with_profile(profile)).error().message;
    };
    CHECK(refusal({}) == "no NoiseProfile");
    CHECK(refusal({ 1e-4, 0, 1 }) == "NoiseProfile of 3 numbers: 2 or 6 are needed");
    CHECK(refusal({ 1e-4, -1e-3 }) == "NoiseProfile: read noise -0.001 is not in [0,1]");
    CHECK(refusal({ 3, 0 }) == "NoiseProfile: shot noise 3 is not in [0,1]");
}

TEST_CASE("noise drawn from the UPI line lies on it, with its scatter, and a seed repeats it")
{
    double sum = 0, squares = 0, lowest = 1, highest = 0;
    constexpr int kDraws = 4000;
    for (int seed = 0; seed < kDraws; ++seed) {
        const NoiseModel noise = upi_noise(std::uint64_t(seed));
        CHECK(noise.shot[0] == noise.shot[2]);
        CHECK(noise.read[0] == noise.read[1]);
        const double off = std::log(noise.read[0]) - 2.18 * std::log(noise.shot[0]) - 1.20;
        sum += off / kDraws;
        squares += off * off / kDraws;
        lowest = std::min(lowest, noise.shot[0]);
        highest = std::max(highest, noise.shot[0]);
    }
    CHECK(std::abs(sum) < 0.02);
    CHECK(std::sqrt(squares) == doctest::Approx(0.26).epsilon(0.05));
    CHECK(lowest == doctest::Approx(1e-4).epsilon(0.01));
    CHECK(highest == doctest::Approx(0.012).epsilon(0.01));
    CHECK(upi_noise(9).shot == upi_noise(9).shot);
}
