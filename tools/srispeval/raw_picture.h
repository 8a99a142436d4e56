// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <srisp/reference.h>

#include "base/matrix3.h"
#include "pixels.h"

namespace srisp::tool {

/// What is known of the colours of a RAW image.
struct RawColors {
    Vector3 white_balance{ 1, 1, 1 };             ///< multipliers of R, G, B that make white white
    Matrix3 to_srgb{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< balanced camera RGB → linear sRGB
    std::optional<Matrix3> to_xyz;                ///< camera RGB as recorded → XYZ; none: no matrix is known
};

/// A RAW image as a test sees it: linear camera RGB, 0 black and 1 saturated, upright.
struct RawPicture {
    Pixels pixels;
    RawColors colors;
    std::string camera;
    int orientation = 1; ///< of what the file stores, as in EXIF
    std::vector<std::string> notes;
};

/// Make and model, without the make where the model repeats it.
std::string camera_name(const CameraFacts& facts);

RawColors colors_of(const CameraFacts& facts, const std::array<double, 3>& means);

/// A RAW file, demosaiced by LibRaw, or a linear image that srisp wrote, no longer than `longest` pixels (area
/// averages; 0: as it is). What is no reference is no picture either (load_reference). Errors name the file.
Expected<RawPicture> load_raw_picture(const std::string& path, int longest);

/// A photo as srisp reads it, display-encoded sRGB in [0,1], upright, of this size; 0 × 0: no longer than `longest`.
/// Error: it has another shape (width / height) than asked for, by more than 2 %.
Expected<Pixels> load_photo(const std::string& path, int width, int height, int longest);

} // namespace srisp::tool
