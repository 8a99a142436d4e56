// SPDX-License-Identifier: Apache-2.0
#include "base/scene_linear_space.h"

#include <algorithm>
#include <cctype>

namespace srisp {

namespace {

SceneLinearSpace rgb_space(const char* name, const char* interop_id, std::vector<const char*> aliases,
                           const Chromaticities& chromaticities)
{
    return { name,
             interop_id,
             std::move(aliases),
             chromaticities,
             white_of(chromaticities),
             inverse(rgb_to_xyz(chromaticities)) };
}

bool same_name(const std::string& a, const std::string& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

} // namespace

const std::vector<SceneLinearSpace>& scene_linear_spaces()
{
    static const std::vector<SceneLinearSpace> spaces = {
        rgb_space("ACEScg", "lin_ap1_scene", { "lin_ap1", "ACES - ACEScg" }, kAp1Chromaticities),
        rgb_space("ACES2065-1", "lin_ap0_scene", { "lin_ap0", "ACES - ACES2065-1" }, kAp0Chromaticities),
        rgb_space("lin_rec709", "lin_rec709_scene",
                  { "lin_srgb", "Linear Rec.709 (sRGB)", "Linear Rec.709", "linear - sRGB", "Utility - Linear - sRGB",
                    "Utility - Linear - Rec.709" },
                  kSrgbChromaticities),
        rgb_space("lin_rec2020", "lin_rec2020_scene", { "Linear Rec.2020", "Utility - Linear - Rec.2020" },
                  kRec2020Chromaticities),
        rgb_space("lin_p3d65", "lin_p3d65_scene", { "Linear P3-D65", "Utility - Linear - P3-D65" },
                  kP3D65Chromaticities),
        // Its channels are X, Y, Z; as chromaticities they have the equal-energy white.
        { "XYZ",
          "lin_ciexyzd65_scene",
          { "CIE XYZ-D65 - Scene-referred", "CIE-XYZ-D65" },
          { 1, 0, 0, 1, 0, 0, 1.0f / 3, 1.0f / 3 },
          kD65,
          { 1, 0, 0, 0, 1, 0, 0, 0, 1 } },
    };
    return spaces;
}

const SceneLinearSpace* find_scene_linear_space(const std::string& name)
{
    for (const SceneLinearSpace& space : scene_linear_spaces())
        if (same_name(name, space.name) || same_name(name, space.interop_id) ||
            std::any_of(space.aliases.begin(), space.aliases.end(),
                        [&](const char* alias) { return same_name(name, alias); }))
            return &space;
    return nullptr;
}

} // namespace srisp
