// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/colorimetry.h"

namespace srisp {

/// A light by its place near the Planckian locus, as converters show it.
struct Light {
    float temperature = 6504; ///< correlated colour temperature, kelvin
    float tint = 0; ///< 3000 × the distance above the locus in CIE 1960 uv: above 0 greener, below more magenta
};

constexpr float kLowestTemperature = 1000, kHighestTemperature = 25000;

/// Its chromaticity. Temperature: kLowestTemperature to kHighestTemperature. The locus by Krystek's approximation
/// (1985), within 1e-4 of uv.
Xy xy_of_light(const Light& light);

/// The light of a chromaticity; temperatures end at the bounds above.
Light light_of_xy(const Xy& xy);

/// The chromaticity that an EXIF LightSource code stands for; none: it says no light (unknown, other).
const Xy* xy_of_light_source(int code);

} // namespace srisp
