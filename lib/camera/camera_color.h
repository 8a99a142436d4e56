// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <srisp/camera.h>

#include "base/colorimetry.h"

// How a camera's values become colours under a light [DNG 1.4, chapter 6, "Mapping Camera Color Space to CIE XYZ"].

namespace srisp {

/// Whether the facts hold a matrix that can be used: finite, and not singular.
bool has_camera_color(const CameraFacts& facts);

/// Camera RGB, the largest 1, of what is neutral under a light. The facts must have a matrix (has_camera_color).
Vector3 neutral_under(const CameraFacts& facts, const Xy& light);

/// Balanced camera RGB (divided by what is neutral) → XYZ under D50; (1,1,1) → D50 with Y = 1. Two matrices are
/// interpolated for the light that the neutral tells, in reciprocal temperature; forward matrices are taken where all
/// have them. The colour matrix of a camera that has one is that of its own light, and balancing in camera RGB does
/// the rest: so do LibRaw and dcraw. The facts must have a matrix; neutral: above 0.
Matrix3 balanced_to_xyz(const CameraFacts& facts, const Vector3& neutral);

/// Multipliers of R, G, B that make white white: by the as-shot neutral, or where there is none those that make these
/// means of an image grey.
Vector3 white_balance_of(const CameraFacts& facts, const std::array<double, 3>& means);

/// Balanced camera RGB → linear sRGB by the matrix for daylight, rows summing to 1; where there is none, as it is.
Matrix3 balanced_to_srgb(const CameraFacts& facts);

} // namespace srisp
