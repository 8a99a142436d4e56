// SPDX-License-Identifier: Apache-2.0
#include "features/fft.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <doctest/doctest.h>

#include "random_model.h"

using namespace srisp;

TEST_CASE("the transform of a few points of a cube is the sum of their waves, and the way back gives them again")
{
    constexpr int side = CubeFft::kSide;
    struct Point {
        int x, y, z;
        std::complex<double> value;
    };
    const Point points[] = { { 0, 0, 0, { 1, 0 } }, { 3, 17, 31, { 0.5, -2 } }, { 16, 8, 5, { -1, 0.25 } } };
    CubeFft cube;
    for (const Point& p : points) {
        cube.real()[CubeFft::at(p.x, p.y, p.z)] = static_cast<float>(p.value.real());
        cube.imaginary()[CubeFft::at(p.x, p.y, p.z)] = static_cast<float>(p.value.imag());
    }
    const std::vector<float> before(cube.real(), cube.real() + CubeFft::kFloats);
    cube.forward();
    double error = 0;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z) {
                std::complex<double> sum;
                for (const Point& p : points)
                    sum += p.value * std::polar(1.0, -2 * M_PI * (x * p.x + y * p.y + z * p.z) / side);
                const int at = CubeFft::at(CubeFft::place(x), CubeFft::place(z), CubeFft::place(y));
                error = std::max(error, std::abs(sum - std::complex<double>(cube.real()[at], cube.imaginary()[at])));
            }
    CHECK(error < 2e-6);
    cube.inverse();
    for (int i = 0; i < CubeFft::kFloats; ++i)
        error = std::max<double>(error, std::fabs(cube.real()[i] / CubeFft::kCells - before[i]));
    CHECK(error < 2e-6);
}

TEST_CASE("a cube of random values comes back")
{
    constexpr int side = CubeFft::kSide;
    Random random(4);
    CubeFft cube;
    const std::vector<float> real = random_values(random, CubeFft::kCells),
                             imaginary = random_values(random, CubeFft::kCells);
    const auto at = [](int cell) { return CubeFft::at(cell / side / side, cell / side % side, cell % side); };
    for (int i = 0; i < CubeFft::kCells; ++i) {
        cube.real()[at(i)] = real[i];
        cube.imaginary()[at(i)] = imaginary[i];
    }
    cube.forward();
    cube.inverse();
    double error = 0;
    for (int i = 0; i < CubeFft::kCells; ++i)
        error = std::max(error, std::hypot(cube.real()[at(i)] / CubeFft::kCells - real[i],
                                           double(cube.imaginary()[at(i)] / CubeFft::kCells - imaginary[i])));
    CHECK(error < 2e-6);
}
