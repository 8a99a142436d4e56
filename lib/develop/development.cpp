// SPDX-License-Identifier: Apache-2.0
// Which numbers develop an image.
#include <algorithm>
#include <cmath>

#include <srisp/develop.h>

#include "base/guarded.h"
#include "base/scene_linear_space.h"
#include "camera/camera_color.h"
#include "camera/light.h"
#include "recipe/option_table.h"

namespace srisp {

namespace {

bool is_known(const Vector3& neutral)
{
    return std::all_of(neutral.begin(), neutral.end(), [](float v) { return std::isfinite(v) && v > 0; });
}

/// The neutral that parameters tell: what their white balance makes grey.
Vector3 neutral_of(const Parameters& parameters)
{
    const auto& [red, green, blue] = parameters.white_balance;
    return { 1 / red, 1 / green, 1 / blue };
}

/// Camera RGB of what is to become white.
Expected<Vector3> chosen_neutral(const DevelopSource& source, const WhiteBalance& balance,
                                 std::vector<std::string>& notes)
{
    using Kind = WhiteBalance::Kind;
    const bool has_color = has_camera_color(source.camera);
    if (balance.kind == Kind::multipliers) {
        const auto& [red, green, blue] = balance.multipliers;
        return Vector3{ 1 / red, 1 / green, 1 / blue };
    }
    if (balance.kind == Kind::light) {
        if (!has_color)
            return Error{ "whitebalance by a light needs a colour matrix, and none is known of the camera" };
        return neutral_under(source.camera, xy_of_light({ balance.temperature, balance.tint }));
    }
    if (balance.kind == Kind::reference && is_known(source.reference_neutral))
        return source.reference_neutral;
    if (balance.kind == Kind::reference)
        notes.push_back("what is white in the reference's light is not known; what is white in the scene was taken");
    if (is_known(source.camera.as_shot_neutral))
        return source.camera.as_shot_neutral;
    if (source.parameters)
        return neutral_of(*source.parameters);
    if (!has_color)
        return Error{ "neither what is white nor a colour matrix is known of the camera" };
    notes.push_back("what is white is not known; daylight (D65) was assumed");
    return neutral_under(source.camera, kD65);
}

/// Balanced camera RGB → XYZ under a white; (1,1,1) becomes that white.
Expected<Matrix3> to_xyz(const DevelopSource& source, const Vector3& neutral, const Xy& white,
                         std::vector<std::string>& notes)
{
    if (has_camera_color(source.camera))
        return product(adaptation(kD50, white), balanced_to_xyz(source.camera, neutral));
    if (!source.parameters)
        return Error{ "no colour matrix is known of the camera" };
    notes.push_back("no colour matrix is known of the camera; the one of the parameters was taken");
    const Matrix3 from_srgb = product(adaptation(kD65, white), rgb_to_xyz(kSrgbChromaticities));
    return product(from_srgb, row_normalized(source.parameters->color));
}

/// The largest balanced value of what was white in an unprocessed photo; 1 where the sensor saturates before.
float white_of_photo(const Parameters& parameters, const Vector3& multipliers)
{
    float most = 0;
    for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, multipliers[c] / (parameters.white_balance[c] * parameters.gain));
    return std::min(most, 1.0f);
}

} // namespace

Expected<Development> choose_development(const DevelopSource& source, const Options& options,
                                         std::vector<std::string>& notes)
{
    return guarded("development", {}, [&]() -> Expected<Development> {
        if (const Status known = check_space(options.develop); !known)
            return known.error();
        const SceneLinearSpace* const space = find_scene_linear_space(options.develop);
        if (!space)
            return Error{ "no colour space is named" };
        const auto neutral = chosen_neutral(source, options.white_balance, notes);
        if (!neutral)
            return neutral.error();
        const auto xyz = to_xyz(source, *neutral, space->white, notes);
        if (!xyz)
            return xyz.error();
        Development result;
        result.space = space->name;
        result.highlights = options.highlights;
        const float most = *std::max_element(neutral->begin(), neutral->end());
        for (std::size_t c = 0; c < 3; ++c)
            result.multipliers[c] = most / (*neutral)[c];
        if (source.parameters)
            result.white = white_of_photo(*source.parameters, result.multipliers);
        result.matrix = product(space->from_xyz, *xyz);
        for (float& element : result.matrix)
            element *= float(std::exp2(options.exposure));
        return result;
    });
}

} // namespace srisp
