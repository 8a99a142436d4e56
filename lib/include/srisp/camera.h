// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include <srisp/export.h>

namespace srisp {

/// What a RAW file says of its camera and exposure. Levels are in the file's own units. Zero or empty: not known.
struct CameraFacts {
    std::string make, model;
    int width = 0, height = 0; ///< active area as stored (before orientation), pixels
    int orientation = 1;       ///< EXIF orientation of the stored pixels
    std::string cfa_pattern;   ///< "RGGB", … from the active area's top left; "" for demosaiced (LinearRaw) images
    std::array<float, 4> black_level{}; ///< mean black level of R, G (first green), B, second green
    float white_level = 0;
    /// Whether the levels are those of samples of 8 to 16 bits: references of floats have a white of 1.
    SRISP_API bool has_integer_levels() const;
    /// For one calibration light. Matrices are row-major, 3×3.
    struct ColorMatrix {
        std::array<float, 9> xyz_to_camera; ///< XYZ → camera RGB
        int illuminant = 0;                 ///< EXIF LightSource code of the light
        std::array<float, 9> forward{};     ///< DNG's forward matrix: balanced camera RGB → XYZ under D50
    };
    std::vector<ColorMatrix> color_matrices;
    /// The matrix for D65, else the first one; null where there is none.
    SRISP_API const ColorMatrix* daylight_matrix() const;
    std::array<float, 3> as_shot_neutral{}; ///< camera RGB of a neutral surface, G = 1
    float iso = 0, exposure_time_s = 0, f_number = 0;
    std::vector<double> noise_profile; ///< DNG NoiseProfile: pairs of shot and read noise, of values in [0,1]
};

} // namespace srisp
