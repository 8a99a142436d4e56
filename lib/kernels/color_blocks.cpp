// SPDX-License-Identifier: Apache-2.0
#include "kernels/color_blocks.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/color_blocks.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

#include "kernels/color_blocks-inl.h"
#include "kernels/pointwise.h"

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {

void after_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    run_after_tone_map(blocks, in, out, count);
}

void before_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    run_before_tone_map(blocks, in, out, count);
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(after_tone_map);
HWY_EXPORT(before_tone_map);

void after_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(after_tone_map)(blocks, in, out, count);
}

void before_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    HWY_DYNAMIC_DISPATCH(before_tone_map)(blocks, in, out, count);
}

namespace scalar {

static float clamped01(float v)
{
    return std::min(std::max(v, 0.0f), 1.0f);
}

static void multiply(Planes in, Planes out, std::size_t count, const float gains[3])
{
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < count; ++x)
            out.plane(c)[x] = clamped01(in.plane(c)[x] * gains[c]);
}

static void rebuild_highlights(Planes in, Planes out, std::size_t count, const float balance[3], float gain)
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

void after_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    scalar::power(in, out, count, blocks.exponent, kPowerFloor);
    scalar::color_transform(out, out, count, blocks.color);
    scalar::inverse_gain(out, out, count, blocks.white_balance);
    scalar::inverse_gain(out, out, count, blocks.gain);
    for (int c = 0; c < 3; ++c)
        std::transform(out.plane(c), out.plane(c) + count, out.plane(c), clamped01);
}

void before_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count)
{
    if (blocks.rebuilds_highlights) {
        rebuild_highlights(in, out, count, blocks.white_balance, blocks.gain[0]);
    } else {
        multiply(in, out, count, blocks.gain);
        multiply(out, out, count, blocks.white_balance);
    }
    scalar::color_transform(out, out, count, blocks.color);
    scalar::power(out, out, count, blocks.exponent, kPowerFloor);
}

} // namespace scalar
} // namespace srisp
#endif
