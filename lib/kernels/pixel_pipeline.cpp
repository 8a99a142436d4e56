// SPDX-License-Identifier: Apache-2.0
#include "kernels/pixel_pipeline.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/pixel_pipeline.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

#include "kernels/color_blocks-inl.h"
#include "kernels/pixel_tone_map-inl.h"
#include "kernels/tone_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

/// clamp01(v + φ(v))
HWY_INLINE void compute_tones(const PixelToneMap& tone_map, const BlockRgb& v, BlockRgb& out)
{
    const D d;
    tone_map_block(tone_map, v, out);
    for (int i = 0; i < 3 * kPixelBlock; i += kLanes)
        hn::Store(clamped01(hn::Add(hn::Load(d, v.values + i), hn::Load(d, out.values + i))), d, out.values + i);
}

/// The same by a table.
HWY_INLINE void look_up_tones(const ToneTable& table, BlockRgb& v, BlockRgb& out)
{
    const D d;
    Tetrahedra<kPixelBlock> tetrahedra;
    for (int x = 0; x < kPixelBlock; x += kLanes) {
        V rgb[3];
        for (int c = 0; c < 3; ++c)
            rgb[c] = hn::Load(d, v.at(c, x));
        find_tetrahedra(rgb, x, tetrahedra);
    }
    HWY_ALIGN float found[ToneTable::kStride * kPixelBlock];
    interpolate(table.values(), tetrahedra, found);
    for (int x = 0; x < kPixelBlock; x += kLanes) {
        V rgb[3], unused;
        hn::LoadInterleaved4(d, found + ToneTable::kStride * x, rgb[0], rgb[1], rgb[2], unused);
        for (int c = 0; c < 3; ++c)
            hn::Store(clamped01(rgb[c]), d, out.at(c, x));
    }
}

enum class Pass { reverse, forward };

template<Pass kPass>
HWY_INLINE void run_block(const PixelPipeline& p, const ToneTable* table, const float* in, float* out)
{
    const D d;
    BlockRgb v, tones;
    for (int x = 0; x < kPixelBlock; x += kLanes) {
        V r, g, b;
        hn::LoadInterleaved3(d, in + 3 * x, r, g, b);
        hn::Store(kPass == Pass::reverse ? clamped01(r) : r, d, v.at(0, x)); // the other way clamps by itself
        hn::Store(kPass == Pass::reverse ? clamped01(g) : g, d, v.at(1, x));
        hn::Store(kPass == Pass::reverse ? clamped01(b) : b, d, v.at(2, x));
    }
    if (kPass == Pass::forward)
        run_before_tone_map(p.blocks, v.planes(), v.planes(), kPixelBlock);
    if (table)
        look_up_tones(*table, v, tones);
    else
        compute_tones(p.tone_map, v, tones);
    if (kPass == Pass::reverse)
        run_after_tone_map(p.blocks, tones.planes(), tones.planes(), kPixelBlock);
    for (int x = 0; x < kPixelBlock; x += kLanes)
        hn::StoreInterleaved3(hn::Load(d, tones.at(0, x)), hn::Load(d, tones.at(1, x)), hn::Load(d, tones.at(2, x)), d,
                              out + 3 * x);
}

template<Pass kPass> HWY_INLINE void run_pixels(const PixelPipeline& p, const ToneTable* table, const float* in,
                                                float* out, std::size_t count)
{
    std::size_t x = 0;
    for (; x + kPixelBlock <= count; x += kPixelBlock)
        run_block<kPass>(p, table, in + 3 * x, out + 3 * x);
    if (x < count) {
        HWY_ALIGN float rest[3 * kPixelBlock] = {};
        std::copy(in + 3 * x, in + 3 * count, rest);
        run_block<kPass>(p, table, rest, rest);
        std::copy_n(rest, 3 * (count - x), out + 3 * x);
    }
}

void reverse_pixels(const PixelPipeline& p, const ToneTable* table, const float* in, float* out, std::size_t count)
{
    run_pixels<Pass::reverse>(p, table, in, out, count);
}

void forward_pixels(const PixelPipeline& p, const ToneTable* table, const float* in, float* out, std::size_t count)
{
    run_pixels<Pass::forward>(p, table, in, out, count);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(reverse_pixels);
HWY_EXPORT(forward_pixels);

void reverse_pixels(const PixelPipeline& pipeline, const ToneTable* table, const float* in, float* out,
                    std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(reverse_pixels)(pipeline, table, in, out, count);
}

void forward_pixels(const PixelPipeline& pipeline, const ToneTable* table, const float* in, float* out,
                    std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(forward_pixels)(pipeline, table, in, out, count);
}

} // namespace srisp
#endif
