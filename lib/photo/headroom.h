// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "gain_map/gain_map.h"

namespace srisp {

/// Row `y` of a photo, display-encoded sRGB, becomes that of its HDR picture: each pixel whose light is more than white
/// is made darker, in all channels alike, until the brightest is white; `headroom` says by what factor (1: not at all).
/// The map's factors are taken as those of sRGB's primaries, which is exact for grey maps.
void apply_gain_map(const GainMap& gain_map, int y, int width, float* rgb, float* headroom);

/// The result of such pixels gets the light back: linear, 3 floats a pixel.
void add_headroom(const float* headroom, std::int64_t pixels, float* linear);

} // namespace srisp
