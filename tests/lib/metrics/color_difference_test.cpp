// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <doctest/doctest.h>
#include <srisp/metrics.h>

using namespace srisp;

TEST_CASE("CIEDE2000 has the values of Sharma, Wu and Dalal's test data, whichever colour comes first")
{
    struct Pair {
        std::array<double, 3> a, b;
        double difference;
    };
    const Pair pairs[] = {
        { { 50, 2.6772, -79.7751 }, { 50, 0, -82.7485 }, 2.0425 },
        { { 50, 3.1571, -77.2803 }, { 50, 0, -82.7485 }, 2.8615 },
        { { 50, 2.8361, -74.0200 }, { 50, 0, -82.7485 }, 3.4412 },
        { { 50, -1.3802, -84.2814 }, { 50, 0, -82.7485 }, 1.0000 },
        { { 50, 0, 0 }, { 50, -1, 2 }, 2.3669 },
        { { 50, 2.4900, -0.0010 }, { 50, -2.4900, 0.0009 }, 7.1792 },
        { { 50, 2.4900, -0.0010 }, { 50, -2.4900, 0.0011 }, 7.2195 },
        { { 50, -0.0010, 2.4900 }, { 50, 0.0009, -2.4900 }, 4.8045 },
        { { 50, 2.5, 0 }, { 73, 25, -18 }, 27.1492 },
        { { 50, 2.5, 0 }, { 61, -5, 29 }, 22.8977 },
        { { 50, 2.5, 0 }, { 56, -27, -3 }, 31.9030 },
        { { 50, 2.5, 0 }, { 58, 24, 15 }, 19.4535 },
        { { 60.2574, -34.0099, 36.2677 }, { 60.4626, -34.1751, 39.4387 }, 1.2644 },
        { { 63.0109, -31.0961, -5.8663 }, { 62.8187, -29.7946, -4.0864 }, 1.2630 },
        { { 61.2901, 3.7196, -5.3901 }, { 61.4292, 2.2480, -4.9620 }, 1.8731 },
        { { 35.0831, -44.1164, 3.7933 }, { 35.0232, -40.0716, 1.5901 }, 1.8645 },
        { { 22.7233, 20.0904, -46.6940 }, { 23.0331, 14.9730, -42.5619 }, 2.0373 },
        { { 36.4612, 47.8580, 18.3852 }, { 36.2715, 50.5065, 21.2231 }, 1.4146 },
        { { 90.8027, -2.0831, 1.4410 }, { 91.1528, -1.6435, 0.0447 }, 1.4441 },
        { { 90.9257, -0.5406, -0.9208 }, { 88.6381, -0.8985, -0.7239 }, 1.5381 },
        { { 6.7747, -0.2908, -2.4247 }, { 5.8714, -0.0985, -2.2286 }, 0.6377 },
        { { 2.0776, 0.0795, -1.1350 }, { 0.9033, -0.0636, -0.5514 }, 0.9082 },
    };
    for (const Pair& pair : pairs) {
        INFO(pair.a[0], " ", pair.a[1], " ", pair.a[2]);
        CHECK(delta_e2000(pair.a, pair.b) == doctest::Approx(pair.difference).epsilon(5e-5 / pair.difference));
        CHECK(delta_e2000(pair.b, pair.a) == doctest::Approx(delta_e2000(pair.a, pair.b)));
    }
}

TEST_CASE("the mean over two images is that of their pixels, of values that a sensor would record")
{
    constexpr std::array<float, 9> as_it_is{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    const std::vector<float> truth{ .2f, .3f, .1f, .5f, .5f, .5f }, result{ .3f, .3f, .1f, 2, .5f, .5f };
    const auto lab = [](double x, double y, double z) { return lab_from_xyz({ x, y, z }); };
    const double expected =
        (delta_e2000(lab(.3f, .3f, .1f), lab(.2f, .3f, .1f)) + delta_e2000(lab(1, .5f, .5f), lab(.5f, .5f, .5f))) / 2;
    CHECK(mean_delta_e2000({ result.data(), 2, 1, 3, 6 }, { truth.data(), 2, 1, 3, 6 }, as_it_is) ==
          doctest::Approx(expected));
}
