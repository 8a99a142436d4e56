// SPDX-License-Identifier: Apache-2.0
#include "features/fft.h"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "features/lanes.h"

namespace srisp {

namespace {

constexpr int kSide = CubeFft::kSide, kPlane = CubeFft::kPlane;

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
template<int kStride>
inline __attribute__((always_inline)) void forward_steps(float* real, float* imaginary, int quarter)
{
    const Roots& root = roots();
    const int step = kSide / 4 / quarter, apart = quarter * kStride;
    for (int j = 0; j < quarter; ++j)
        for (int block = j; block < kSide; block += 4 * quarter)
            for (int i = block * kStride; i < block * kStride + kSide; i += kLanes) {
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
template<int kStride>
inline __attribute__((always_inline)) void inverse_steps(float* real, float* imaginary, int quarter)
{
    const Roots& root = roots();
    const int step = kSide / 4 / quarter, apart = quarter * kStride;
    for (int j = 0; j < quarter; ++j)
        for (int block = j; block < kSide; block += 4 * quarter)
            for (int i = block * kStride; i < block * kStride + kSide; i += kLanes) {
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
template<int kStride> inline __attribute__((always_inline)) void neighbour_step(float* real, float* imaginary)
{
    for (int row = 0; row < kSide * kStride; row += 2 * kStride)
        for (int i = row; i < row + kSide; i += kLanes) {
            Complex a, b;
            load(real + i, imaginary + i, a);
            load(real + i + kStride, imaginary + i + kStride, b);
            store({ a.re + b.re, a.im + b.im }, real + i, imaginary + i);
            store({ a.re - b.re, a.im - b.im }, real + i + kStride, imaginary + i + kStride);
        }
}

/// 32 columns side by side, rows of which lie kStride apart. Frequencies come out with their bits reversed.
template<int kStride> inline __attribute__((always_inline)) void forward_columns(float* real, float* imaginary)
{
    forward_steps<kStride>(real, imaginary, kSide / 4);
    forward_steps<kStride>(real, imaginary, kSide / 16);
    neighbour_step<kStride>(real, imaginary);
}

/// From reversed order back.
template<int kStride> inline __attribute__((always_inline)) void inverse_columns(float* real, float* imaginary)
{
    neighbour_step<kStride>(real, imaginary);
    inverse_steps<kStride>(real, imaginary, kSide / 16);
    inverse_steps<kStride>(real, imaginary, kSide / 4);
}

/// A square of eight by eight: rows become columns.
inline __attribute__((always_inline)) void transpose_block(Lanes (&rows)[kLanes])
{
    Lanes pairs[kLanes], fours[kLanes];
    for (int i = 0; i < kLanes; i += 2) {
        pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
        pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    for (int i = 0; i < kLanes; i += 4)
        for (int k = 0; k < 2; ++k) {
            const Lanes &a = pairs[i + k], &b = pairs[i + k + 2];
            fours[i + 2 * k] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
            fours[i + 2 * k + 1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int i = 0; i < kLanes / 2; ++i) {
        const Lanes &a = fours[i], &b = fours[i + 4];
        rows[i] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
        rows[i + 4] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
    }
}

inline __attribute__((always_inline)) void load_block(const float* from, Lanes (&rows)[kLanes])
{
    for (int i = 0; i < kLanes; ++i)
        srisp::load(from + i * kSide, rows[i]);
}

inline __attribute__((always_inline)) void store_block(const Lanes (&rows)[kLanes], float* to)
{
    for (int i = 0; i < kLanes; ++i)
        srisp::store(rows[i], to + i * kSide);
}

inline __attribute__((always_inline)) void transpose(float* plane)
{
    for (int y = 0; y < kSide; y += kLanes)
        for (int x = 0; x <= y; x += kLanes) {
            float *const below = plane + y * kSide + x, *const above = plane + x * kSide + y;
            Lanes rows[kLanes], mirrored[kLanes];
            load_block(below, rows);
            load_block(above, mirrored);
            transpose_block(rows);
            transpose_block(mirrored);
            store_block(rows, above);
            store_block(mirrored, below);
        }
}

/// Along x.
SRISP_WIDE_LANES void forward_x(float* real, float* imaginary)
{
    for (int y = 0; y < kSide; ++y)
        forward_columns<kPlane>(real + y * kSide, imaginary + y * kSide);
}
SRISP_WIDE_LANES void inverse_x(float* real, float* imaginary)
{
    for (int y = 0; y < kSide; ++y)
        inverse_columns<kPlane>(real + y * kSide, imaginary + y * kSide);
}

/// Along both other axes, which change places.
SRISP_WIDE_LANES void forward_plane(float* real, float* imaginary)
{
    forward_columns<kSide>(real, imaginary);
    transpose(real);
    transpose(imaginary);
    forward_columns<kSide>(real, imaginary);
}
SRISP_WIDE_LANES void inverse_plane(float* real, float* imaginary)
{
    inverse_columns<kSide>(real, imaginary);
    transpose(real);
    transpose(imaginary);
    inverse_columns<kSide>(real, imaginary);
}

} // namespace

int CubeFft::place(int k)
{
    int reversed = 0;
    for (int bit = 1; bit < kSide; bit *= 2)
        reversed = 2 * reversed + ((k & bit) ? 1 : 0);
    return reversed;
}

void CubeFft::forward()
{
    forward_x(real(), imaginary());
    for (int x = 0; x < kSide; ++x)
        forward_plane(real() + at(x, 0, 0), imaginary() + at(x, 0, 0));
}

void CubeFft::inverse()
{
    for (int x = 0; x < kSide; ++x)
        inverse_plane(real() + at(x, 0, 0), imaginary() + at(x, 0, 0));
    inverse_x(real(), imaginary());
}

} // namespace srisp
