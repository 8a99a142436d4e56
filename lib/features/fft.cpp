// SPDX-License-Identifier: Apache-2.0
#include "features/fft.h"

#include <array>
#include <cmath>
#include <utility>

namespace srisp {

namespace {

constexpr int kSide = CubeFft::kSide, kPlane = kSide * kSide;

/// exp(−2πi j / 32)
struct Roots {
    std::array<float, kSide / 2> cosine, sine;

    Roots()
    {
        for (int j = 0; j < kSide / 2; ++j) {
            const double angle = 2 * M_PI * j / kSide;
            cosine[j] = static_cast<float>(std::cos(angle));
            sine[j] = static_cast<float>(-std::sin(angle));
        }
    }
};

const Roots& roots()
{
    static const Roots table;
    return table;
}

/// Frequencies come out with their bits reversed.
void forward_columns(float* real, float* imaginary, int stride)
{
    for (int half = kSide / 2; half > 0; half /= 2)
        for (int j = 0; j < half; ++j) {
            const float c = roots().cosine[j * (kSide / 2) / half], s = roots().sine[j * (kSide / 2) / half];
            for (int block = j; block < kSide; block += 2 * half) {
                float *const ar = real + block * stride, *const ai = imaginary + block * stride;
                float *const br = ar + half * stride, *const bi = ai + half * stride;
                for (int i = 0; i < kSide; ++i) {
                    const float dr = ar[i] - br[i], di = ai[i] - bi[i];
                    ar[i] += br[i];
                    ai[i] += bi[i];
                    br[i] = dr * c - di * s;
                    bi[i] = dr * s + di * c;
                }
            }
        }
}

/// From reversed order back.
void inverse_columns(float* real, float* imaginary, int stride)
{
    for (int half = 1; half < kSide; half *= 2)
        for (int j = 0; j < half; ++j) {
            const float c = roots().cosine[j * (kSide / 2) / half], s = -roots().sine[j * (kSide / 2) / half];
            for (int block = j; block < kSide; block += 2 * half) {
                float *const ar = real + block * stride, *const ai = imaginary + block * stride;
                float *const br = ar + half * stride, *const bi = ai + half * stride;
                for (int i = 0; i < kSide; ++i) {
                    const float tr = br[i] * c - bi[i] * s, ti = br[i] * s + bi[i] * c;
                    br[i] = ar[i] - tr;
                    bi[i] = ai[i] - ti;
                    ar[i] += tr;
                    ai[i] += ti;
                }
            }
        }
}

void transpose(float* plane)
{
    for (int y = 1; y < kSide; ++y)
        for (int x = 0; x < y; ++x)
            std::swap(plane[y * kSide + x], plane[x * kSide + y]);
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
    for (int y = 0; y < kSide; ++y)
        columns(real() + y * kSide, imaginary() + y * kSide, kPlane);
}

void CubeFft::transform_planes(Columns columns)
{
    for (int x = 0; x < kSide; ++x) {
        float *const plane_real = real() + x * kPlane, *const plane_imaginary = imaginary() + x * kPlane;
        columns(plane_real, plane_imaginary, kSide);
        transpose(plane_real);
        transpose(plane_imaginary);
        columns(plane_real, plane_imaginary, kSide);
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
