// SPDX-License-Identifier: Apache-2.0
#include "kernels/pointwise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/pointwise.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;

HWY_INLINE V clamped01(V v)
{
    const D d;
    return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f));
}

/// Calls body(index of the first pixel) for every vector of `count` pixels.
template<class Body> HWY_INLINE void for_each_vector(std::size_t count, Body body)
{
    for (std::size_t x = 0; x < count; x += hn::Lanes(D()))
        body(x);
}

/// log2 of a positive normal number, in two parts: the integer `e` and the returned fraction in [−½, ½], which is exact
/// near 0, so that powers of numbers near 1 are too. atanh series: the first term left out is 7e-10.
HWY_INLINE V split_log2(V v, V& e)
{
    const D d;
    const DI di;
    const auto sqrt_half = hn::Set(di, 0x3f3504f3); // bits of √½: mantissas lie in [√½, √2)
    const auto shifted = hn::Sub(hn::BitCast(di, v), sqrt_half);
    e = hn::ConvertTo(d, hn::ShiftRight<23>(shifted));
    const V m = hn::BitCast(d, hn::Add(hn::And(shifted, hn::Set(di, 0x7fffff)), sqrt_half));
    const V s = hn::Div(hn::Sub(m, hn::Set(d, 1.0f)), hn::Add(m, hn::Set(d, 1.0f)));
    const V s2 = hn::Mul(s, s);
    V series = hn::MulAdd(s2, hn::Set(d, 1.0f / 9), hn::Set(d, 1.0f / 7));
    series = hn::MulAdd(s2, series, hn::Set(d, 1.0f / 5));
    series = hn::MulAdd(s2, series, hn::Set(d, 1.0f / 3));
    const V sum = hn::MulAdd(hn::Mul(s2, s), series, s);
    return hn::Mul(sum, hn::Set(d, 2.885390081777927f)); // 2 / ln 2
}

/// 2^(n + r), n an integer in [−126, 127], r in [−½, ½]; Taylor: the first term left out is 5e-9.
HWY_INLINE V exp2_of(V n, V r)
{
    const D d;
    const DI di;
    V p = hn::Set(d, 1.5252734e-05f);
    for (const float coefficient :
         { 1.5403530e-04f, 1.3333558e-03f, 9.6181291e-03f, 5.5504109e-02f, 2.4022651e-01f, 6.9314718e-01f, 1.0f })
        p = hn::MulAdd(p, r, hn::Set(d, coefficient));
    const auto exponent = hn::Add(hn::ConvertTo(di, n), hn::Set(di, 127));
    return hn::Mul(p, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
}

/// An exponent in two parts: `high` has 12 bits, so that its product with the exponent of a float is exact, FMA or not.
struct SplitExponent {
    V whole, high, low;

    explicit SplitExponent(float exponent)
    {
        const D d;
        std::uint32_t bits;
        std::memcpy(&bits, &exponent, sizeof bits);
        bits &= 0xfffff000u;
        float high_part;
        std::memcpy(&high_part, &bits, sizeof bits);
        whole = hn::Set(d, exponent);
        high = hn::Set(d, high_part);
        low = hn::Set(d, exponent - high_part);
    }
};

/// v^exponent, v > 0 and normal. The integer part of log2 costs no precision; only the fraction carries an error.
HWY_INLINE V pow_of(V v, const SplitExponent& exponent)
{
    const D d;
    V e;
    const V fraction = split_log2(v, e);
    const V small = hn::MulAdd(exponent.whole, fraction, hn::Mul(exponent.low, e));
    const V large = hn::Mul(exponent.high, e);
    const V n = hn::Min(hn::Max(hn::Round(hn::Add(large, small)), hn::Set(d, -126.0f)), hn::Set(d, 127.0f));
    const V r = hn::Add(hn::Sub(large, n), small);
    return exp2_of(n, hn::Min(hn::Max(r, hn::Set(d, -1.0f)), hn::Set(d, 1.0f)));
}

void clamp01(Planes in, Planes out, std::size_t count)
{
    const D d;
    for (int c = 0; c < 3; ++c)
        for_each_vector(
            count, [&](std::size_t x) { hn::StoreU(clamped01(hn::LoadU(d, in.plane(c) + x)), d, out.plane(c) + x); });
}

void power(Planes in, Planes out, std::size_t count, float exponent, float floor, float offset)
{
    const D d;
    const SplitExponent e(exponent);
    const V lowest = hn::Set(d, floor), shift = hn::Set(d, offset);
    for (int c = 0; c < 3; ++c)
        for_each_vector(count, [&](std::size_t x) {
            const V v = hn::Max(hn::LoadU(d, in.plane(c) + x), lowest);
            hn::StoreU(hn::Add(pow_of(v, e), shift), d, out.plane(c) + x);
        });
}

void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& m)
{
    const D d;
    for_each_vector(count, [&](std::size_t x) {
        const V r = hn::LoadU(d, in.plane(0) + x), g = hn::LoadU(d, in.plane(1) + x), b = hn::LoadU(d, in.plane(2) + x);
        for (int c = 0; c < 3; ++c) {
            V sum = hn::Mul(hn::Set(d, m[c * 3]), r);
            sum = hn::MulAdd(hn::Set(d, m[c * 3 + 1]), g, sum);
            sum = hn::MulAdd(hn::Set(d, m[c * 3 + 2]), b, sum);
            hn::StoreU(clamped01(sum), d, out.plane(c) + x);
        }
    });
}

void multiply(Planes in, Planes out, std::size_t count, const float gains[3])
{
    const D d;
    for (int c = 0; c < 3; ++c) {
        const V gain = hn::Set(d, gains[c]);
        for_each_vector(count, [&](std::size_t x) {
            hn::StoreU(clamped01(hn::Mul(hn::LoadU(d, in.plane(c) + x), gain)), d, out.plane(c) + x);
        });
    }
}

void inverse_gain(Planes in, Planes out, std::size_t count, const float scales[3])
{
    const D d;
    const V one = hn::Set(d, 1.0f), knee = hn::Set(d, 0.9f), ten = hn::Set(d, 10.0f), third = hn::Set(d, 1.0f / 3);
    for_each_vector(count, [&](std::size_t x) {
        const V r = hn::LoadU(d, in.plane(0) + x), g = hn::LoadU(d, in.plane(1) + x), b = hn::LoadU(d, in.plane(2) + x);
        const V grey = hn::Mul(hn::Add(hn::Add(r, g), b), third);
        const V above = clamped01(hn::Mul(hn::Sub(grey, knee), ten));
        const V m = hn::Mul(above, above), rest = hn::Sub(one, m);
        const V in_rgb[] = { r, g, b };
        for (int c = 0; c < 3; ++c) {
            const V s = hn::Set(d, scales[c]);
            hn::StoreU(hn::Mul(in_rgb[c], hn::Max(hn::MulAdd(rest, s, m), s)), d, out.plane(c) + x);
        }
    });
}

void rebuild_highlights(Planes in, Planes out, std::size_t count, const float balance[3], float gain)
{
    const D d;
    const V one = hn::Set(d, 1.0f), knee = hn::Set(d, 2.9f), ten = hn::Set(d, 10.0f);
    const V g = hn::Set(d, gain), most = hn::Set(d, 1 / gain), per_rest = hn::Set(d, 1 / (1 / gain - 1));
    for_each_vector(count, [&](std::size_t x) {
        V u[3];
        for (int c = 0; c < 3; ++c)
            u[c] = hn::Min(hn::Mul(clamped01(hn::LoadU(d, in.plane(c) + x)), hn::Set(d, balance[c])), most);
        const V sum = hn::Add(hn::Add(hn::Min(u[0], one), hn::Min(u[1], one)), hn::Min(u[2], one));
        const V top = hn::Max(hn::Max(u[0], u[1]), hn::Max(u[2], one));
        const V near_white = clamped01(hn::Mul(hn::Sub(sum, knee), ten));
        const V root = hn::Mul(near_white, hn::Mul(hn::Sub(top, one), per_rest)), m = hn::Mul(root, root);
        for (int c = 0; c < 3; ++c)
            hn::StoreU(clamped01(hn::Mul(g, hn::MulAdd(m, hn::Sub(top, u[c]), u[c]))), d, out.plane(c) + x);
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
HWY_EXPORT(multiply);
HWY_EXPORT(inverse_gain);
HWY_EXPORT(rebuild_highlights);
HWY_EXPORT(split_channels);
HWY_EXPORT(join_channels);

void clamp01(Planes in, Planes out, std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(clamp01)(in, out, count);
}
void power(Planes in, Planes out, std::size_t count, float exponent, float floor, float offset)
{
    HWY_DYNAMIC_DISPATCH(power)(in, out, count, exponent, floor, offset);
}
void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& matrix)
{
    HWY_DYNAMIC_DISPATCH(color_transform)(in, out, count, matrix);
}
void multiply(Planes in, Planes out, std::size_t count, const float gains[3])
{
    HWY_DYNAMIC_DISPATCH(multiply)(in, out, count, gains);
}
void inverse_gain(Planes in, Planes out, std::size_t count, const float scales[3])
{
    HWY_DYNAMIC_DISPATCH(inverse_gain)(in, out, count, scales);
}
void rebuild_highlights(Planes in, Planes out, std::size_t count, const float balance[3], float gain)
{
    HWY_DYNAMIC_DISPATCH(rebuild_highlights)(in, out, count, balance, gain);
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

void power(Planes in, Planes out, std::size_t count, float exponent, float floor, float offset)
{
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < count; ++x)
            out.plane(c)[x] = std::pow(std::max(in.plane(c)[x], floor), exponent) + offset;
}

void color_transform(Planes in, Planes out, std::size_t count, const Matrix3& m)
{
    for (std::size_t x = 0; x < count; ++x) {
        const float r = in.plane(0)[x], g = in.plane(1)[x], b = in.plane(2)[x];
        for (int c = 0; c < 3; ++c)
            out.plane(c)[x] = clamped01(m[c * 3] * r + m[c * 3 + 1] * g + m[c * 3 + 2] * b);
    }
}

void multiply(Planes in, Planes out, std::size_t count, const float gains[3])
{
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < count; ++x)
            out.plane(c)[x] = clamped01(in.plane(c)[x] * gains[c]);
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

void rebuild_highlights(Planes in, Planes out, std::size_t count, const float balance[3], float gain)
{
    for (std::size_t x = 0; x < count; ++x) {
        float u[3], sum = 0, top = 1;
        for (int c = 0; c < 3; ++c) {
            u[c] = std::min(clamped01(in.plane(c)[x]) * balance[c], 1 / gain);
            sum += std::min(u[c], 1.0f);
            top = std::max(top, u[c]);
        }
        const float root = clamped01((sum - 2.9f) * 10) * (top - 1) / (1 / gain - 1), m = root * root;
        for (int c = 0; c < 3; ++c)
            out.plane(c)[x] = clamped01(gain * (u[c] + m * (top - u[c])));
    }
}

} // namespace scalar
} // namespace srisp
#endif
