// SPDX-License-Identifier: Apache-2.0
#include "reference/libraw_facts.h"

#include <algorithm>
#include <cmath>

namespace srisp {

namespace {

/// EXIF orientation of dcraw's flip: 1 mirrors left-right, 2 top-bottom, 4 swaps the axes first.
int orientation_of_flip(int flip)
{
    static const int kOrientations[] = { 1, 2, 4, 3, 5, 8, 6, 7 };
    return flip >= 0 && flip < 8 ? kOrientations[flip] : 1;
}

float known(float value)
{
    return std::isfinite(value) && value > 0 ? value : 0;
}

} // namespace

void describe_camera(const libraw_data_t& data, CameraFacts& facts, std::vector<std::string>& notes)
{
    facts.make = data.idata.make;
    facts.model = data.idata.model;
    facts.orientation = orientation_of_flip(data.sizes.flip);

    const auto& matrix = data.color.cam_xyz; // LibRaw's table of Adobe's D65 matrices
    if (matrix[0][0] != 0) {
        CameraFacts::ColorMatrix entry;
        for (std::size_t i = 0; i < 9; ++i)
            entry.xyz_to_camera[i] = matrix[i / 3][i % 3];
        entry.illuminant = 21; // D65
        facts.color_matrices.push_back(entry);
        notes.push_back("colour matrix from LibRaw's table for this camera (D65), not from the file");
    }
    const auto& multipliers = data.color.cam_mul;
    if (known(multipliers[0]) > 0 && known(multipliers[1]) > 0 && known(multipliers[2]) > 0)
        facts.as_shot_neutral = { multipliers[1] / multipliers[0], 1, multipliers[1] / multipliers[2] };
    facts.iso = known(data.other.iso_speed);
    facts.exposure_time_s = known(data.other.shutter);
    facts.f_number = known(data.other.aperture);
}

} // namespace srisp
