// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "base/matrix3.h"

// From chromaticities to matrices. XYZ is CIE 1931, Y = 1 for white.

namespace srisp {

/// CIE x and y.
using Xy = std::array<float, 2>;

/// CIE xy of red, green, blue and white, as EXR's `chromaticities` and PNG's cHRM have them.
using Chromaticities = std::array<float, 8>;

constexpr Chromaticities kSrgbChromaticities{ 0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f };
constexpr Chromaticities kRec2020Chromaticities{ 0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f };
constexpr Chromaticities kP3D65Chromaticities{ 0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.3127f, 0.3290f };
/// ACES2065-1, which EXR files of the ACES container hold [SMPTE ST 2065-1], and ACEScg [ACES S-2014-004].
constexpr Chromaticities kAp0Chromaticities{ 0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.077f, 0.32168f, 0.33767f };
constexpr Chromaticities kAp1Chromaticities{ 0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f };

constexpr Xy kD50{ 0.34567f, 0.35850f }, kD65{ 0.3127f, 0.3290f };

inline Xy white_of(const Chromaticities& c)
{
    return { c[6], c[7] };
}

/// sRGB's encoding of a linear value, and back; from 0 on. [IEC 61966-2-1]
double srgb_curve(double linear);
double srgb_curve_back(double encoded);

/// XYZ of the colour with this xy and Y = 1; y must not be 0.
Vector3 xyz_of(const Xy& xy);

/// The xy of a colour; its X + Y + Z must not be 0.
Xy xy_of(const Vector3& xyz);

/// The primaries' directions in XYZ, a column each.
Matrix3 primaries_matrix(const Chromaticities& chromaticities);

/// Linear RGB → XYZ, where (1,1,1) is the white with Y = 1. The primaries must not lie on a line.
Matrix3 rgb_to_xyz(const Chromaticities& chromaticities);

/// XYZ under one white → XYZ under another (linear Bradford).
Matrix3 adaptation(const Xy& from_white, const Xy& to_white);

} // namespace srisp
