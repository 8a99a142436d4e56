// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "kernels/color_blocks.h"
#include "kernels/pixel_tone_map.h"
#include "kernels/tone_table.h"

namespace srisp {

/// All of a pointwise model's pipeline in one direction.
struct PixelPipeline {
    PixelToneMap tone_map;
    ColorBlocks blocks;
};

// `count` pixels, interleaved RGB, through the whole pipeline, a few at a time: they are read once and written once.
// `in` and `out` may be the same memory, and nothing beside these pixels is touched. Each pixel gets the same bits
// wherever it lies. Vectorised, dispatched at run time. With a table the tone map is looked up in that, but for the
// pixels that lie outside the unit cube: these come out as without one.

void reverse_pixels(const PixelPipeline& pipeline, const ToneTable* table, const float* in, float* out,
                    std::size_t count);
void forward_pixels(const PixelPipeline& pipeline, const ToneTable* table, const float* in, float* out,
                    std::size_t count);

} // namespace srisp
