// SPDX-License-Identifier: Apache-2.0
#include "features/fft.h"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "features/lanes.h"

namespace srisp {

namespace {

constexpr int kSide = CubeFft::kSide, kPlane = kSide * kSide;

constexpr int kTurns = 3 * kSide / 4; // most that the steps use

/// exp(−2πi j / 32)
struct Roots {
    std::array<float, kTurns> cosine, sine;

    Roots()
    {
        for (int j = 0; j < kTurns; ++j) {
            const double angle = 2 * M_PI * j / kSide;
            cosine[j] = static_cast<float>(std::cos(angle));
            sine[j] = static_cast<float>(-std::sin(angle));
        }
    }
};

/// Eight complex numbers, of eight columns.
struct Complex {
    Lanes re, im;
};

inline __attribute__((always_inline)) void load(const float* real, const float* imaginary, Complex& to)
{
    srisp::load(real, to.re);
    srisp::load(imaginary, to.im);
}

inline __attribute__((always_inline)) void store(const Complex& from, float* real, float* imaginary)
{
    srisp::store(from.re, real);
    srisp::store(from.im, imaginary);
}

/// a = a · (c + is)
inline __attribute__((always_inline)) void turn(Complex& a, float c, float s)
{
    const Lanes re = a.re * c - a.im * s;
    a.im = a.re * s + a.im * c;
    a.re = re;
}

const Roots& roots()
{
    static const Roots table;
    return table;
}

/// Two steps at once, on what is 4, then 2 `quarter`s apart: they pass memory once.
inline __attribute__((always_inline)) void forward_steps(float* real, float* imaginary, int quarter)
{
    const Roots& root = roots();
    const int step = kSide / 4 / quarter, apart = quarter * kSide;
    for (int j = 0; j < quarter; ++j)
        for (int block = j; block < kSide; block += 4 * quarter)
            for (int i = block * kSide; i < (block + 1) * kSide; i += kLanes) {
                float *const re = real + i, *const im = imaginary + i;
                Complex x0, x1, x2, x3;
                load(re, im, x0);
                load(re + apart, im + apart, x1);
                load(re + 2 * apart, im + 2 * apart, x2);
                load(re + 3 * apart, im + 3 * apart, x3);
                const Complex u0{ x0.re + x2.re, x0.im + x2.im }, u1{ x1.re + x3.re, x1.im + x3.im };
                const Complex v0{ x0.re - x2.re, x0.im - x2.im }, v1{ x1.im - x3.im, x3.re - x1.re }; // v1: · −i
                Complex y1{ u0.re - u1.re, u0.im - u1.im }, y2{ v0.re + v1.re, v0.im + v1.im },
                    y3{ v0.re - v1.re, v0.im - v1.im };
                turn(y1, root.cosine[2 * j * step], root.sine[2 * j * step]);
                turn(y2, root.cosine[j * step], root.sine[j * step]);
                turn(y3, root.cosine[3 * j * step], root.sine[3 * j * step]);
                store({ u0.re + u1.re, u0.im + u1.im }, re, im);
                store(y1, re + apart, im + apart);
                store(y2, re + 2 * apart, im + 2 * apart);
                store(y3, re + 3 * apart, im + 3 * apart);
            }
}

/// The same back.
inline __attribute__((always_inline)) void inverse_steps(float* real, float* imaginary, int quarter)
{
    const Roots& root = roots();
    const int step = kSide / 4 / quarter, apart = quarter * kSide;
    for (int j = 0; j < quarter; ++j)
        for (int block = j; block < kSide; block += 4 * quarter)
            for (int i = block * kSide; i < (block + 1) * kSide; i += kLanes) {
                float *const re = real + i, *const im = imaginary + i;
                Complex x0, x1, x2, x3;
                load(re, im, x0);
                load(re + apart, im + apart, x1);
                load(re + 2 * apart, im + 2 * apart, x2);
                load(re + 3 * apart, im + 3 * apart, x3);
                turn(x1, root.cosine[2 * j * step], -root.sine[2 * j * step]);
                turn(x2, root.cosine[j * step], -root.sine[j * step]);
                turn(x3, root.cosine[3 * j * step], -root.sine[3 * j * step]);
                const Complex a0{ x0.re + x1.re, x0.im + x1.im }, a1{ x0.re - x1.re, x0.im - x1.im };
                const Complex b0{ x2.re + x3.re, x2.im + x3.im }, b1{ x3.im - x2.im, x2.re - x3.re }; // b1: · i
                store({ a0.re + b0.re, a0.im + b0.im }, re, im);
                store({ a1.re + b1.re, a1.im + b1.im }, re + apart, im + apart);
                store({ a0.re - b0.re, a0.im - b0.im }, re + 2 * apart, im + 2 * apart);
                store({ a1.re - b1.re, a1.im - b1.im }, re + 3 * apart, im + 3 * apart);
            }
}

/// The step between neighbours, the same in both directions.
inline __attribute__((always_inline)) void neighbour_step(float* real, float* imaginary)
{
    for (int row = 0; row < kPlane; row += 2 * kSide)
        for (int i = row; i < row + kSide; i += kLanes) {
            Complex a, b;
            load(real + i, imaginary + i, a);
            load(real + i + kSide, imaginary + i + kSide, b);
            store({ a.re + b.re, a.im + b.im }, real + i, imaginary + i);
            store({ a.re - b.re, a.im - b.im }, real + i + kSide, imaginary + i + kSide);
        }
}

/// 32 columns side by side. Frequencies come out with their bits reversed.
SRISP_WIDE_LANES void forward_columns(float* real, float* imaginary)
{
    forward_steps(real, imaginary, kSide / 4);
    forward_steps(real, imaginary, kSide / 16);
    neighbour_step(real, imaginary);
}

/// From reversed order back.
SRISP_WIDE_LANES void inverse_columns(float* real, float* imaginary)
{
    neighbour_step(real, imaginary);
    inverse_steps(real, imaginary, kSide / 16);
    inverse_steps(real, imaginary, kSide / 4);
}

void transpose(float* plane)
{
    for (int y = 1; y < kSide; ++y)
        for (int x = 0; x < y; ++x)
            std::swap(plane[y * kSide + x], plane[x * kSide + y]);
}

/// Rows of one y, from all planes of a cube, and back.
void gather(const float* cube, float* rows)
{
    for (int x = 0; x < kSide; ++x)
        std::memcpy(rows + x * kSide, cube + x * kPlane, kSide * sizeof(float));
}
void scatter(const float* rows, float* cube)
{
    for (int x = 0; x < kSide; ++x)
        std::memcpy(cube + x * kPlane, rows + x * kSide, kSide * sizeof(float));
}

} // namespace

int CubeFft::place(int k)
{
    int reversed = 0;
    for (int bit = 1; bit < kSide; bit *= 2)
        reversed = 2 * reversed + ((k & bit) ? 1 : 0);
    return reversed;
}

void CubeFft::transform_x(Columns columns)
{
    // In a copy: what lies 4 KB apart gets into each other's way in the cache.
    float rows_real[kPlane], rows_imaginary[kPlane];
    for (int y = 0; y < kSide; ++y) {
        gather(real() + y * kSide, rows_real);
        gather(imaginary() + y * kSide, rows_imaginary);
        columns(rows_real, rows_imaginary);
        scatter(rows_real, real() + y * kSide);
        scatter(rows_imaginary, imaginary() + y * kSide);
    }
}

void CubeFft::transform_planes(Columns columns)
{
    for (int x = 0; x < kSide; ++x) {
        float *const plane_real = real() + x * kPlane, *const plane_imaginary = imaginary() + x * kPlane;
        columns(plane_real, plane_imaginary);
        transpose(plane_real);
        transpose(plane_imaginary);
        columns(plane_real, plane_imaginary);
    }
}

void CubeFft::forward()
{
    transform_x(forward_columns);
    transform_planes(forward_columns);
}

void CubeFft::inverse()
{
    transform_planes(inverse_columns);
    transform_x(inverse_columns);
}

} // namespace srisp
