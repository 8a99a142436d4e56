// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set, by Highway's convention for such files.
#if defined(SRISP_TONE_TABLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SRISP_TONE_TABLE_INL_H_
#undef SRISP_TONE_TABLE_INL_H_
#else
#define SRISP_TONE_TABLE_INL_H_
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "kernels/tone_table.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;

// A point's three channels lie side by side, so four loads of four floats per pixel fetch the corners, whatever the
// instruction set. Gathers fetch single floats: twelve per pixel.

/// Between which points of the table kCount pixels lie, and how much each of them counts: the corners of a tetrahedron,
/// from the cell's lower corner to its upper one by way of the channels that are furthest in it.
template<int kCount> struct Tetrahedra {
    HWY_ALIGN std::int32_t corners[3]
                                  [kCount]; ///< floats from the table's start; the fourth: kUpperCorner from the first
    HWY_ALIGN float weights[4][kCount];
};

constexpr int kBlueStep = ToneTable::kStride, kGreenStep = ToneTable::kSide * kBlueStep;
constexpr int kRedStep = ToneTable::kSide * kGreenStep, kUpperCorner = kRedStep + kGreenStep + kBlueStep;

/// For the vector of pixels that starts with the x-th; `rgb` in [0, 1].
template<int kCount> HWY_INLINE void find_tetrahedra(const V rgb[3], int x, Tetrahedra<kCount>& found)
{
    const D d;
    const DI di;
    const V red = hn::Set(d, float(kRedStep)), green = hn::Set(d, float(kGreenStep));
    const V blue = hn::Set(d, float(kBlueStep)), upper = hn::Set(d, float(kUpperCorner));
    const V steps[] = { red, green, blue };
    V inside[3], lower = hn::Zero(d);
    for (int c = 0; c < 3; ++c) {
        const V at = hn::Mul(rgb[c], hn::Set(d, float(ToneTable::kSide - 1)));
        const V cell = hn::Min(hn::Floor(at), hn::Set(d, float(ToneTable::kSide - 2)));
        inside[c] = hn::Sub(at, cell);
        lower = hn::MulAdd(cell, steps[c], lower);
    }
    const V more = hn::Max(inside[0], inside[1]), less = hn::Min(inside[0], inside[1]);
    const V most = hn::Max(more, inside[2]), least = hn::Min(less, inside[2]);
    const V middle = hn::Max(less, hn::Min(more, inside[2]));
    const auto red_first = hn::Ge(inside[0], inside[1]);
    const V first = hn::IfThenElse(hn::Ge(inside[2], more), blue, hn::IfThenElse(red_first, red, green));
    const V last = hn::IfThenElse(hn::Le(inside[2], less), blue, hn::IfThenElse(red_first, green, red));
    hn::Store(hn::ConvertTo(di, lower), di, found.corners[0] + x);
    hn::Store(hn::ConvertTo(di, hn::Add(lower, first)), di, found.corners[1] + x);
    hn::Store(hn::ConvertTo(di, hn::Sub(hn::Add(lower, upper), last)), di, found.corners[2] + x);
    hn::Store(hn::Sub(hn::Set(d, 1.0f), most), d, found.weights[0] + x);
    hn::Store(hn::Sub(most, middle), d, found.weights[1] + x);
    hn::Store(hn::Sub(middle, least), d, found.weights[2] + x);
    hn::Store(least, d, found.weights[3] + x);
}

/// `out`: kStride floats a pixel.
template<int kCount> HWY_INLINE void interpolate(const float* table, const Tetrahedra<kCount>& at, float* out)
{
    const hn::CappedTag<float, ToneTable::kStride> d;
    constexpr int n = static_cast<int>(hn::MaxLanes(d));
    for (int x = 0; x < kCount; ++x)
        for (int c = 0; c < static_cast<int>(ToneTable::kStride); c += n) { // once but where vectors are single floats
            const float* const lower = table + at.corners[0][x] + c;
            auto sum = hn::Mul(hn::LoadU(d, lower), hn::Set(d, at.weights[0][x]));
            sum = hn::MulAdd(hn::LoadU(d, table + at.corners[1][x] + c), hn::Set(d, at.weights[1][x]), sum);
            sum = hn::MulAdd(hn::LoadU(d, table + at.corners[2][x] + c), hn::Set(d, at.weights[2][x]), sum);
            sum = hn::MulAdd(hn::LoadU(d, lower + kUpperCorner), hn::Set(d, at.weights[3][x]), sum);
            hn::StoreU(sum, d, out + ToneTable::kStride * x + c);
        }
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#endif
