// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set, by Highway's convention for such files.
#if defined(SRISP_COLOR_BLOCKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SRISP_COLOR_BLOCKS_INL_H_
#undef SRISP_COLOR_BLOCKS_INL_H_
#else
#define SRISP_COLOR_BLOCKS_INL_H_
#endif

#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#include "kernels/color_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The blocks of the pipeline on vectors of pixels; what they compute is said in color_blocks.h and pointwise.h.

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;

/// NaN becomes 0: of a number and none Max gives the second on x86.
HWY_INLINE V clamped01(V v)
{
    const D d;
    return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f));
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

HWY_INLINE void transform_color(V rgb[3], const Matrix3& m)
{
    const D d;
    const V r = rgb[0], g = rgb[1], b = rgb[2];
    for (int c = 0; c < 3; ++c) {
        V sum = hn::Mul(hn::Set(d, m[c * 3]), r);
        sum = hn::MulAdd(hn::Set(d, m[c * 3 + 1]), g, sum);
        sum = hn::MulAdd(hn::Set(d, m[c * 3 + 2]), b, sum);
        rgb[c] = clamped01(sum);
    }
}

HWY_INLINE void multiply_by(V rgb[3], const float gains[3])
{
    for (int c = 0; c < 3; ++c)
        rgb[c] = clamped01(hn::Mul(rgb[c], hn::Set(D(), gains[c])));
}

/// How much highlights keep of their own when gains are undone: 0 in all else.
HWY_INLINE V kept_share(const V rgb[3])
{
    const D d;
    const V knee = hn::Set(d, 0.9f), ten = hn::Set(d, 10.0f), third = hn::Set(d, 1.0f / 3);
    const V grey = hn::Mul(hn::Add(hn::Add(rgb[0], rgb[1]), rgb[2]), third);
    const V above = clamped01(hn::Mul(hn::Sub(grey, knee), ten));
    return hn::Mul(above, above);
}

/// What a value is multiplied with when a gain of 1 / scale is undone.
HWY_INLINE V undoing_factor(V kept, float scale)
{
    const D d;
    const V s = hn::Set(d, scale);
    return hn::Max(hn::MulAdd(hn::Sub(hn::Set(d, 1.0f), kept), s, kept), s);
}

HWY_INLINE void undo_gain(V rgb[3], const float scales[3])
{
    const V kept = kept_share(rgb);
    for (int c = 0; c < 3; ++c)
        rgb[c] = hn::Mul(rgb[c], undoing_factor(kept, scales[c]));
}

HWY_INLINE void rebuild_clipped(V rgb[3], const float balance[3], float gain)
{
    const D d;
    const V one = hn::Set(d, 1.0f), knee = hn::Set(d, 2.9f), ten = hn::Set(d, 10.0f);
    const V g = hn::Set(d, gain), most = hn::Set(d, 1 / gain), per_rest = hn::Set(d, 1 / (1 / gain - 1));
    V u[3];
    for (int c = 0; c < 3; ++c)
        u[c] = hn::Min(hn::Mul(clamped01(rgb[c]), hn::Set(d, balance[c])), most);
    const V sum = hn::Add(hn::Add(hn::Min(u[0], one), hn::Min(u[1], one)), hn::Min(u[2], one));
    const V top = hn::Max(hn::Max(u[0], u[1]), hn::Max(u[2], one));
    const V near_white = clamped01(hn::Mul(hn::Sub(sum, knee), ten));
    const V root = hn::Mul(near_white, hn::Mul(hn::Sub(top, one), per_rest)), m = hn::Mul(root, root);
    for (int c = 0; c < 3; ++c)
        rgb[c] = clamped01(hn::Mul(g, hn::MulAdd(m, hn::Sub(top, u[c]), u[c])));
}

/// Calls body(index of the first pixel) for every vector of `count` pixels.
template<class Body> HWY_INLINE void for_each_vector(std::size_t count, Body body)
{
    for (std::size_t x = 0; x < count; x += hn::Lanes(D()))
        body(x);
}

/// Replaces each vector of three channels by what body(V rgb[3]) makes of it.
template<class Body> HWY_INLINE void for_each_rgb(Planes in, Planes out, std::size_t count, Body body)
{
    const D d;
    for_each_vector(count, [&](std::size_t x) {
        V rgb[3];
        for (int c = 0; c < 3; ++c)
            rgb[c] = hn::LoadU(d, in.plane(c) + x);
        body(rgb);
        for (int c = 0; c < 3; ++c)
            hn::StoreU(rgb[c], d, out.plane(c) + x);
    });
}

HWY_INLINE void run_power(Planes in, Planes out, std::size_t count, float exponent, float floor)
{
    const D d;
    const SplitExponent e(exponent);
    const V lowest = hn::Set(d, floor);
    for (int c = 0; c < 3; ++c)
        for_each_vector(count, [&](std::size_t x) {
            const V v = hn::Max(hn::LoadU(d, in.plane(c) + x), lowest);
            hn::StoreU(pow_of(v, e), d, out.plane(c) + x);
        });
}

// Powers are long chains of instructions, each of which waits for the one before: they get a loop of their own, of
// which a processor overlaps several rounds. With the other blocks in the same loop all of them took 1.25 times as
// long.

HWY_INLINE void run_after_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    run_power(in, out, count, blocks.exponent, kPowerFloor);
    for_each_rgb(out, out, count, [&](V rgb[3]) {
        transform_color(rgb, blocks.color);
        undo_gain(rgb, blocks.white_balance);
        undo_gain(rgb, blocks.gain);
        for (int c = 0; c < 3; ++c)
            rgb[c] = clamped01(rgb[c]);
    });
}

HWY_INLINE void run_before_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    for_each_rgb(in, out, count, [&](V rgb[3]) {
        if (blocks.rebuilds_highlights) {
            rebuild_clipped(rgb, blocks.white_balance, blocks.gain[0]);
        } else {
            multiply_by(rgb, blocks.gain);
            multiply_by(rgb, blocks.white_balance);
        }
        transform_color(rgb, blocks.color);
    });
    run_power(out, out, count, blocks.exponent, kPowerFloor);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#endif
