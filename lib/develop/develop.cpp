// SPDX-License-Identifier: Apache-2.0
// A development's pixels, and the way back. The same bits for any number of threads.
#include <algorithm>
#include <cmath>
#include <string>

#include <srisp/develop.h>

#include "base/guarded.h"
#include "base/matrix3.h"
#include "base/parallel.h"
#include "develop/undo_matrix.h"

namespace srisp {

namespace {

Status check_sizes(ImageView in, MutableImageView out)
{
    if (in.width == out.width && in.height == out.height)
        return {};
    return Error{ "an image of " + std::to_string(in.width) + " × " + std::to_string(in.height) +
                  " pixels does not fit into one of " + std::to_string(out.width) + " × " +
                  std::to_string(out.height) };
}

/// Calls row(y) for each row, on several threads.
template<class Row> void each_row(int height, int threads, const Row& row)
{
    constexpr int kRows = 16; // of a task
    parallel_tasks((height + kRows - 1) / kRows, threads, [&](std::int64_t task) {
        for (int y = int(task) * kRows; y < std::min((int(task) + 1) * kRows, height); ++y)
            row(y);
    });
}

/// As bright as `v`, as colourful as what is left of it below `most`.
inline void blend_highlights(float v[3], float most)
{
    if (!(std::max({ v[0], v[1], v[2] }) > most))
        return;
    const float clipped[3] = { std::min(v[0], most), std::min(v[1], most), std::min(v[2], most) };
    const float mean = (v[0] + v[1] + v[2]) / 3, clipped_mean = (clipped[0] + clipped[1] + clipped[2]) / 3;
    float color = 0, clipped_color = 0;
    for (int c = 0; c < 3; ++c) {
        color += (v[c] - mean) * (v[c] - mean);
        clipped_color += (clipped[c] - clipped_mean) * (clipped[c] - clipped_mean);
    }
    const float ratio = color > 0 ? std::sqrt(clipped_color / color) : 0;
    for (int c = 0; c < 3; ++c)
        v[c] = mean + (v[c] - mean) * ratio;
}

inline void times_matrix(const Matrix3& m, const float v[3], float* out)
{
    for (int row = 0; row < 3; ++row)
        out[row] = m[row * 3] * v[0] + m[row * 3 + 1] * v[1] + m[row * 3 + 2] * v[2];
}

/// Where colour is multiplied with alpha, that is the most a saturated channel has. Where nothing is opaque, colour is
/// light that is added, and stays as it is.
inline float saturation(float alpha)
{
    return alpha > 0 ? alpha : 1;
}

template<Highlights highlights> void develop_row(const Development& d, const float* in, std::ptrdiff_t in_stride,
                                                 const float* alpha, float* out, std::ptrdiff_t out_stride, int width)
{
    for (int x = 0; x < width; ++x) {
        float v[3];
        for (int c = 0; c < 3; ++c)
            v[c] = in[x * in_stride + c] * d.multipliers[c];
        if constexpr (highlights != Highlights::keep) {
            const float most = d.white * (alpha ? saturation(alpha[x * in_stride]) : 1);
            if constexpr (highlights == Highlights::clip)
                for (float& value : v)
                    value = value > most ? most : value; // NaN stays
            else
                blend_highlights(v, most);
        }
        times_matrix(d.matrix, v, out + x * out_stride);
    }
}

} // namespace

Status develop(const Development& development, ImageView in, MutableImageView out, const float* alpha, int threads)
{
    return guarded("development", {}, [&] {
        const auto row_of = [&] {
            switch (development.highlights) {
            case Highlights::clip:
                return develop_row<Highlights::clip>;
            case Highlights::blend:
                return develop_row<Highlights::blend>;
            case Highlights::keep:
                break;
            }
            return develop_row<Highlights::keep>;
        }();
        const Status fit = check_sizes(in, out);
        if (fit)
            each_row(in.height, threads, [&](int y) {
                row_of(development, in.pixel(0, y), in.x_stride, alpha ? alpha + y * in.y_stride : nullptr,
                       out.pixel(0, y), out.x_stride, in.width);
            });
        return fit;
    });
}

Status undo_development(const Development& development, ImageView in, MutableImageView out, int threads)
{
    return guarded("development", {}, [&] {
        const Matrix3 back = undo_matrix(development);
        const Status fit = check_sizes(in, out);
        if (fit)
            each_row(in.height, threads, [&](int y) {
                for (int x = 0; x < in.width; ++x) {
                    const float* const pixel = in.pixel(x, y);
                    const float v[3] = { pixel[0], pixel[1], pixel[2] };
                    times_matrix(back, v, out.pixel(x, y));
                }
            });
        return fit;
    });
}

} // namespace srisp
