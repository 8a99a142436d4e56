// SPDX-License-Identifier: Apache-2.0
#include "kernels/pixel_tone_map.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/pixel_tone_map.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

#include "kernels/pixel_tone_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void tone_map_pixels(const PixelToneMap& tone_map, Planes in, Planes out, std::size_t count)
{
    const D d;
    constexpr int n = static_cast<int>(hn::MaxLanes(d));
    static_assert(kPixelBlock <= kRowSlack, "the last block ends in the room behind the row");
    for (std::size_t x = 0; x < count; x += kPixelBlock) {
        BlockRgb v, phi;
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < kPixelBlock; k += n)
                hn::Store(hn::LoadU(d, in.plane(c) + x + k), d, v.at(c, k));
        tone_map_block(tone_map, v, phi);
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < kPixelBlock; k += n)
                hn::StoreU(hn::Add(hn::Load(d, v.at(c, k)), hn::Load(d, phi.at(c, k))), d, out.plane(c) + x + k);
    }
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(tone_map_pixels);

void tone_map_pixels(const PixelToneMap& tone_map, Planes in, Planes out, std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(tone_map_pixels)(tone_map, in, out, count);
}

PixelToneMap pack_pixel_tone_map(const std::array<ConvolutionWeights, kToneLayers>& layers)
{
    PixelToneMap packed;
    for (int l = 0; l < kToneLayers; ++l)
        packed[l] = pack_convolution(layers[l]);
    return packed;
}

} // namespace srisp
#endif
