// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/colorimetry.h"

namespace srisp {

/// A scene-linear colour space.
struct SceneLinearSpace {
    const char* name;                 ///< as OpenImageIO and most OpenColorIO configurations have it
    const char* interop_id;           ///< of the Color Interop Forum, which OpenImageIO 3.1 and later have
    std::vector<const char*> aliases; ///< other names that these use
    Chromaticities chromaticities;
    Xy white;
    Matrix3 from_xyz; ///< XYZ under its white → the space
};

/// ACEScg, ACES2065-1, lin_rec709, lin_rec2020, lin_p3d65, and XYZ (under D65).
const std::vector<SceneLinearSpace>& scene_linear_spaces();

/// By one of its names, whatever their case; null: there is none.
const SceneLinearSpace* find_scene_linear_space(const std::string& name);

} // namespace srisp
