// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include <srisp/camera.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>
#include <srisp/options.h>
#include <srisp/parameters.h>

// From linear camera RGB to a scene-linear colour space, and back: what raw developers do without a look.

namespace srisp {

/// How camera RGB is developed: each channel times its multiplier, highlights, then the matrix.
struct Development {
    std::string space;                                        ///< the scene-linear colour space, by its first name
    std::array<float, 3> multipliers{ 1, 1, 1 };              ///< of R, G, B; the least is 1, so white is where the
                                                              ///< first channel of a neutral saturates
    std::array<float, 9> matrix{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< row-major: balanced camera RGB → space, with exposure
    Highlights highlights = Highlights::clip;
    float white = 1; ///< balanced value above which highlights are clipped or blended
};

/// What a development is made of.
struct DevelopSource {
    CameraFacts camera;                       ///< color_matrices; as_shot_neutral is what is neutral in the scene
    std::array<float, 3> reference_neutral{}; ///< camera RGB of what is neutral in the reference; 0: not known
    /// Of an unprocessed photo; may be null. Their gain says where the photo was white: above that a RAW-like image is
    /// drawn to the sensor's white, which is no neutral. Their color is taken where there is no matrix.
    const Parameters* parameters = nullptr;
};

/// Chooses the development that `options` ask for (develop, white_balance, exposure, highlights). Matrices as in the
/// DNG specification: two are interpolated for the light that the neutral tells, forward matrices are taken where there
/// are, white is adapted by Bradford; a single one, and balance in camera RGB, as in LibRaw and dcraw. `notes`: what
/// was assumed. Errors: a space that is not known (the known ones listed), a light without a matrix, no matrix and no
/// parameters.
SRISP_API Expected<Development> choose_development(const DevelopSource& source, const Options& options,
                                                   std::vector<std::string>& notes);

/// Camera RGB (0 black, 1 saturated) → scene-linear colour; values below 0 and above 1 stay where highlights are not
/// clipped, NaN too. Both may be the same memory. `alpha`: of each pixel, with the strides of `in`, where colour is
/// multiplied with it: saturation lies there then; null: there is none. `threads` 0: as many as OpenImageIO uses.
/// Error: images of two sizes.
SRISP_API Status develop(const Development& development, ImageView in, MutableImageView out,
                         const float* alpha = nullptr, int threads = 0);

/// The way back: exact but for highlights that were clipped or blended.
SRISP_API Status undo_development(const Development& development, ImageView in, MutableImageView out, int threads = 0);

/// As JSON text, one line, and from it. `where` names the source of the text in messages. Errors: not JSON, wrong or
/// missing values, a matrix that has no inverse.
SRISP_API std::string to_json(const Development& development);
SRISP_API Expected<Development> development_from_json(const std::string& text, const std::string& where);

} // namespace srisp
