// SPDX-License-Identifier: Apache-2.0
#include "kernels/pointwise.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/pointwise.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

#include "kernels/color_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void clamp01(Planes in, Planes out, std::size_t count)
{
    const D d;
    for (int c = 0; c < 3; ++c)
        for_each_vector(
            count, [&](std::size_t x) { hn::StoreU(clamped01(hn::LoadU(d, in.plane(c) + x)), d, out.plane(c) + x); });
}

void power(Planes in, Planes out, std::size_t count, float exponent, float floor)
{
    run_power(in, out, count, exponent, floor);
}

void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& matrix)
{
    for_each_rgb(in, out, count, [&](V rgb[3]) { transform_color(rgb, matrix); });
}

void inverse_gain(Planes in, Planes out, std::size_t count, const float scales[3])
{
    for_each_rgb(in, out, count, [&](V rgb[3]) { undo_gain(rgb, scales); });
}

void power_of_inverse_gain(Planes in, Planes powers, Planes out, std::size_t count, const float scales[3],
                           float exponent, float floor)
{
    const D d;
    const SplitExponent e(exponent);
    const V lowest = pow_of(hn::Set(d, floor), e);
    V plain_factors[3];
    for (int c = 0; c < 3; ++c)
        plain_factors[c] = pow_of(hn::Set(d, scales[c]), e);
    for_each_vector(count, [&](std::size_t x) {
        V rgb[3];
        for (int c = 0; c < 3; ++c)
            rgb[c] = hn::LoadU(d, in.plane(c) + x);
        const V kept = kept_share(rgb);
        const bool highlights = !hn::AllFalse(d, hn::Gt(kept, hn::Zero(d)));
        for (int c = 0; c < 3; ++c) {
            const V factor = highlights ? pow_of(undoing_factor(kept, scales[c]), e) : plain_factors[c];
            hn::StoreU(hn::Max(hn::Mul(hn::LoadU(d, powers.plane(c) + x), factor), lowest), d, out.plane(c) + x);
        }
    });
}

void split_channels(const float* rgb, Planes out, std::size_t count)
{
    const D d;
    std::size_t x = 0;
    for (const std::size_t n = hn::Lanes(d); x + n <= count; x += n) {
        V r, g, b;
        hn::LoadInterleaved3(d, rgb + 3 * x, r, g, b);
        hn::StoreU(r, d, out.plane(0) + x);
        hn::StoreU(g, d, out.plane(1) + x);
        hn::StoreU(b, d, out.plane(2) + x);
    }
    for (; x < count; ++x)
        for (int c = 0; c < 3; ++c)
            out.plane(c)[x] = rgb[3 * x + c];
}

void join_channels(Planes in, float* rgb, std::size_t count)
{
    const D d;
    std::size_t x = 0;
    for (const std::size_t n = hn::Lanes(d); x + n <= count; x += n)
        hn::StoreInterleaved3(hn::LoadU(d, in.plane(0) + x), hn::LoadU(d, in.plane(1) + x),
                              hn::LoadU(d, in.plane(2) + x), d, rgb + 3 * x);
    for (; x < count; ++x)
        for (int c = 0; c < 3; ++c)
            rgb[3 * x + c] = in.plane(c)[x];
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(clamp01);
HWY_EXPORT(power);
HWY_EXPORT(color_transform);
HWY_EXPORT(inverse_gain);
HWY_EXPORT(power_of_inverse_gain);
HWY_EXPORT(split_channels);
HWY_EXPORT(join_channels);

void clamp01(Planes in, Planes out, std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(clamp01)(in, out, count);
}
void power(Planes in, Planes out, std::size_t count, float exponent, float floor)
{
    HWY_DYNAMIC_DISPATCH(power)(in, out, count, exponent, floor);
}
void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& matrix)
{
    HWY_DYNAMIC_DISPATCH(color_transform)(in, out, count, matrix);
}
void inverse_gain(Planes in, Planes out, std::size_t count, const float scales[3])
{
    HWY_DYNAMIC_DISPATCH(inverse_gain)(in, out, count, scales);
}
void power_of_inverse_gain(Planes in, Planes powers, Planes out, std::size_t count, const float scales[3],
                           float exponent, float floor)
{
    HWY_DYNAMIC_DISPATCH(power_of_inverse_gain)(in, powers, out, count, scales, exponent, floor);
}
void split_channels(const float* rgb, Planes out, std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(split_channels)(rgb, out, count);
}
void join_channels(Planes in, float* rgb, std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(join_channels)(in, rgb, count);
}

namespace scalar {

static float clamped01(float v)
{
    return std::min(std::max(v, 0.0f), 1.0f);
}

void power(Planes in, Planes out, std::size_t count, float exponent, float floor)
{
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < count; ++x)
            out.plane(c)[x] = std::pow(std::max(in.plane(c)[x], floor), exponent);
}

void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& m)
{
    for (std::size_t x = 0; x < count; ++x) {
        const float r = in.plane(0)[x], g = in.plane(1)[x], b = in.plane(2)[x];
        for (int c = 0; c < 3; ++c)
            out.plane(c)[x] = clamped01(m[c * 3] * r + m[c * 3 + 1] * g + m[c * 3 + 2] * b);
    }
}

void inverse_gain(Planes in, Planes out, std::size_t count, const float scales[3])
{
    for (std::size_t x = 0; x < count; ++x) {
        const float rgb[] = { in.plane(0)[x], in.plane(1)[x], in.plane(2)[x] };
        const float above = clamped01(((rgb[0] + rgb[1] + rgb[2]) / 3 - 0.9f) / 0.1f), m = above * above;
        for (int c = 0; c < 3; ++c)
            out.plane(c)[x] = rgb[c] * std::max(m + (1 - m) * scales[c], scales[c]);
    }
}

} // namespace scalar
} // namespace srisp
#endif
