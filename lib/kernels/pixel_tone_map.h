// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "base/planes.h"
#include "kernels/convolution.h"

namespace srisp {

/// Channels between the layers of a tone map.
constexpr int kToneChannels = 32;

/// The tone map of a pointwise model: φ, four layers of 1×1 kernels, packed.
using PixelToneMap = std::array<PackedConvolution, kToneLayers>;

PixelToneMap pack_pixel_tone_map(const std::array<ConvolutionWeights, kToneLayers>& layers);

/// v + φ(v), not clamped, of `count` pixels v; planes as in pointwise.h. Each pixel gets the same bits wherever it
/// lies.
void tone_map_pixels(const PixelToneMap& tone_map, Planes in, Planes out, std::size_t count);

} // namespace srisp
