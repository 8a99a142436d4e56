// SPDX-License-Identifier: Apache-2.0
#include "reference/raw_pixels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/scale_shorts.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void scale_shorts(const std::uint16_t* source, const float* black, const float* factor, std::size_t count,
                  float* target)
{
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> integers;
    const hn::Rebind<std::uint16_t, decltype(d)> shorts;
    const auto one = hn::Set(d, 1.0f);
    std::size_t x = 0;
    for (const std::size_t n = hn::Lanes(d); x + n <= count; x += n) {
        const auto value = hn::ConvertTo(d, hn::PromoteTo(integers, hn::LoadU(shorts, source + x)));
        const auto scaled = hn::Mul(hn::Sub(value, hn::LoadU(d, black + x)), hn::LoadU(d, factor + x));
        hn::StoreU(hn::Min(hn::Max(scaled, hn::Zero(d)), one), d, target + x);
    }
    for (; x < count; ++x)
        target[x] = std::min(std::max((float(source[x]) - black[x]) * factor[x], 0.0f), 1.0f);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(scale_shorts);

void scale_shorts(const std::uint16_t* source, const float* black, const float* factor, std::size_t count,
                  float* target)
{
    HWY_DYNAMIC_DISPATCH(scale_shorts)(source, black, factor, count, target);
}

} // namespace srisp
#endif
