// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include <srisp/image.h>

#include "base/matrix3.h"
#include "base/random.h"

// How photos of test images are made of their RAW. That decides the score, so it never changes with what a training is
// given, and scores of different renderings are kept apart. [method 5]

namespace srisp {

/// A RAW image, whole: linear camera RGB in [0,1], and what is known of its colours.
struct RawScene {
    ImageView raw;
    Vector3 white_balance; ///< true multipliers (R, 1, B)
    Matrix3 color;         ///< white-balanced camera RGB → linear sRGB, the camera's own; rows sum to 1
};

/// One pixel: linear camera RGB in [0,1] → display-encoded sRGB in [0,1], not rounded.
using TestRendering = std::function<Vector3(const Vector3& raw)>;

/// Fixed exposure target, true white balance, the camera's own matrix, sRGB's curve.
TestRendering fixed_rendering(const RawScene& scene);

/// ISP_rand: white balance, exposure, gamma and tone curve are random, the matrix is a mix of `matrices`, which other
/// cameras have. [method 4 and the second series of 6]
TestRendering random_rendering(const RawScene& scene, const std::vector<Matrix3>& matrices, const Random& random);

/// As cameras and RAW converters do: one gain for each camera, one curve for each image whatever it shows, mostly true
/// white balance and the camera's own matrix.
TestRendering camera_rendering(const RawScene& scene, const std::vector<Matrix3>& matrices, double camera_gain,
                               const Random& random);
/// The gain of a camera: log-normal.
double draw_camera_gain(Random random);

/// Renders all pixels and rounds them to 8 bits. `photo` has the size of `raw`, and may be its memory.
void render(const TestRendering& rendering, ImageView raw, MutableImageView photo);

/// The four cameras of the Darmstadt Noise Dataset as UPI uses them (Brooks et al. 2019): linear sRGB → camera RGB,
/// rows sum to 1.
const std::vector<Matrix3>& dnd_rgb_to_camera();
/// Their inverses, white-balanced camera RGB → linear sRGB: what renderings take where no other camera is known.
const std::vector<Matrix3>& dnd_camera_to_rgb();

} // namespace srisp
