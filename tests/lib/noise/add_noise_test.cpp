// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>
#include <srisp/noise.h>

using namespace srisp;

namespace {

NoiseModel same_noise(double shot, double read)
{
    NoiseModel noise;
    noise.shot.fill(shot);
    noise.read.fill(read);
    return noise;
}

constexpr int kWidth = 1000, kHeight = 500;

/// A plane of one value, with noise.
std::vector<float> noisy_plane(float value, const NoiseModel& noise, std::uint64_t seed = 1)
{
    std::vector<float> plane(std::size_t(kWidth) * kHeight, value);
    REQUIRE(add_noise({ plane.data(), kWidth, kHeight, 1, kWidth }, {}, noise, seed));
    return plane;
}

struct Moments {
    double mean = 0, variance = 0, skew = 0;

    explicit Moments(const std::vector<float>& values)
    {
        const double n = double(values.size());
        for (const float v : values)
            mean += double(v) / n;
        double cubes = 0;
        for (const float v : values) {
            variance += std::pow(double(v) - mean, 2) / n;
            cubes += std::pow(double(v) - mean, 3) / n;
        }
        skew = variance > 0 ? cubes / std::pow(variance, 1.5) : 0;
    }
};

} // namespace

TEST_CASE("noise has the mean, variance and skew of Poisson's and a normal distribution at every level")
{
    constexpr double kShot = 0.001;
    for (const double read : { 0.0, 1e-6, 1e-4 })
        for (const double electrons : { 0.1, 1.0, 5.0, 30.0, 63.5, 64.5, 200.0, 900.0 }) {
            const double value = electrons * kShot, variance = kShot * value + read;
            const Moments moments(noisy_plane(float(value), same_noise(kShot, read)));
            INFO("electrons ", electrons, ", read ", read);
            const double n = double(kWidth) * kHeight; // five standard deviations each
            CHECK(moments.mean == doctest::Approx(value).epsilon(5 * std::sqrt(variance / n) / value));
            const double kurtosis = kShot * kShot * kShot * value / (variance * variance);
            CHECK(moments.variance == doctest::Approx(variance).epsilon(5 * std::sqrt((2 + kurtosis) / n)));
            const double skew = electrons < kPoissonElectrons ? kShot * kShot * value / std::pow(variance, 1.5) : 0;
            CHECK(std::abs(moments.skew - skew) < 5 * std::sqrt(6 / n) * (1 + 3 * skew * skew));
        }
}

TEST_CASE("few electrons are counted: only whole ones, and each number as often as Poisson says")
{
    constexpr double kShot = 0.01;
    for (const double electrons : { 0.05, 0.7, 3.0, 12.0 }) {
        const std::vector<float> plane = noisy_plane(float(electrons * kShot), same_noise(kShot, 0));
        std::vector<double> seen(200);
        std::size_t broken = 0;
        for (const float value : plane) {
            const double count = double(value) / double(float(kShot));
            broken += std::abs(count - std::round(count)) > 1e-5;
            seen[std::size_t(std::round(count))] += 1;
        }
        CHECK(broken == 0);
        const double n = double(plane.size());
        double probability = std::exp(-electrons);
        for (std::size_t k = 0; k < 30; probability *= electrons / double(++k)) {
            INFO("electrons ", electrons, ", count ", k);
            CHECK(std::abs(seen[k] - n * probability) < 5 * std::sqrt(n * probability) + 1);
        }
    }
}

TEST_CASE("noise depends on a pixel's place in the whole image alone: not on tiles, strides, order or threads")
{
    const NoiseModel noise{ { 0.001, 0.002, 0.004 }, { 1e-5, 2e-5, 3e-5 } };
    constexpr int kWide = 2100, kHigh = 40, kX = -3, kY = -7;
    std::vector<float> whole(std::size_t(kWide) * kHigh);
    for (std::size_t i = 0; i < whole.size(); ++i)
        whole[i] = float(i % 977) / 2000;
    std::vector<float> tiles(2 * whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i)
        tiles[2 * i] = whole[i];
    const MosaicPlace place{ BayerPhase::grbg, kX, kY };
    REQUIRE(add_noise({ whole.data(), kWide, kHigh, 1, kWide }, place, noise, 5, 1));
    const int columns[] = { 0, 1, 6, 1030, 1500, kWide }, rows[] = { 0, 17, 18, kHigh };
    for (std::size_t r = 3; r-- > 0;) // bottom up
        for (std::size_t c = 0; c < 5; ++c) {
            const int x = columns[c], y = rows[r];
            const MutablePlaneView tile{ tiles.data() + 2 * (y * kWide + x), columns[c + 1] - x, rows[r + 1] - y, 2,
                                         2 * kWide };
            REQUIRE(add_noise(tile, { place.phase, kX + x, kY + y }, noise, 5, 3));
        }
    std::size_t differ = 0, touched = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        differ += tiles[2 * i] != whole[i];
        touched += tiles[2 * i + 1] != 0;
    }
    CHECK(differ == 0);
    CHECK(touched == 0);
}

TEST_CASE("another seed makes other noise, and neighbours' noise is unrelated")
{
    const NoiseModel noise = same_noise(0, 1e-4);
    const std::vector<float> a = noisy_plane(0.5f, noise, 1), b = noisy_plane(0.5f, noise, 2),
                             c = noisy_plane(0.5f, noise, std::uint64_t(1) << 32 | 1);
    const auto correlation = [](const std::vector<float>& one, const std::vector<float>& other, std::size_t shift) {
        double sum = 0;
        for (std::size_t i = shift; i < one.size(); ++i)
            sum += (double(one[i]) - 0.5) * (double(other[i - shift]) - 0.5);
        return sum / (1e-4 * double(one.size()));
    };
    constexpr double kFive = 5 / 707.0; // standard deviations
    CHECK(std::abs(correlation(a, b, 0)) < kFive);
    CHECK(std::abs(correlation(a, c, 0)) < kFive);
    CHECK(correlation(a, a, 0) == doctest::Approx(1).epsilon(0.02));
    for (const std::size_t shift : { 1, 2, 3, 4, kWidth, kWidth + 1 })
        CHECK(std::abs(correlation(a, a, shift)) < kFive);
}

TEST_CASE("each colour has its own noise, by the phase")
{
    const NoiseModel noise{ { 0, 0, 0 }, { 1e-4, 4e-4, 9e-4 } };
    for (const BayerPhase phase : { BayerPhase::rggb, BayerPhase::grbg, BayerPhase::gbrg, BayerPhase::bggr }) {
        std::vector<float> plane(std::size_t(kWidth) * kHeight, 0.5f);
        REQUIRE(add_noise({ plane.data(), kWidth, kHeight, 1, kWidth }, { phase, 1, 2 }, noise, 3));
        double sums[3] = {}, counts[3] = {};
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const int color = bayer_color(phase, x + 1, y + 2);
                sums[color] += std::pow(double(plane[std::size_t(y * kWidth + x)]) - 0.5, 2);
                counts[color] += 1;
            }
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(sums[c] / counts[c] == doctest::Approx(noise.read[c]).epsilon(0.03));
    }
}

TEST_CASE("values below 0 keep their read noise alone, and no noise changes nothing")
{
    const Moments below(noisy_plane(-0.25f, same_noise(0.01, 1e-4)));
    CHECK(below.mean == doctest::Approx(-0.25).epsilon(0.001));
    CHECK(below.variance == doctest::Approx(1e-4).epsilon(0.02));
    CHECK(noisy_plane(0.3f, same_noise(0, 0)) == std::vector<float>(std::size_t(kWidth) * kHeight, 0.3f));
    CHECK(noisy_plane(0, same_noise(0.01, 0)) == std::vector<float>(std::size_t(kWidth) * kHeight, 0.0f));
}

TEST_CASE("NaN, infinity and impossible noise are refused")
{
    for (const float bad : { std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity() })
        for (const int x : { 0, 7, 1099 }) {
            std::vector<float> plane(1100 * 20, 0.5f);
            plane[std::size_t(18 * 1100 + x)] = bad;
            const Status added = add_noise({ plane.data(), 1100, 20, 1, 1100 }, { {}, 10, 20 }, same_noise(0.01, 0), 1);
            CHECK(added.error().message == "value " + std::string(std::isnan(bad) ? "nan" : "inf") + " of pixel (" +
                                               std::to_string(10 + x) + ", 38): noise needs finite ones");
        }
    float value = 0.5f;
    const auto refusal = [&](const NoiseModel& noise) {
        return add_noise({ &value, 1, 1, 1, 1 }, {}, noise, 1).error();
    };
    CHECK(refusal(same_noise(-1, 0)).message == "shot noise -1 is not in [0,1]");
    CHECK(refusal(same_noise(0, std::nan(""))).message == "read noise nan is not in [0,1]");
    CHECK(value == 0.5f);
}
