// SPDX-License-Identifier: Apache-2.0
#include "camera/camera_color.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "camera/light.h"

namespace srisp {

namespace {

using ColorMatrix = CameraFacts::ColorMatrix;

bool is_invertible(const Matrix3& m)
{
    return std::all_of(m.begin(), m.end(), [](float v) { return std::isfinite(v); }) &&
           std::fabs(determinant(m)) > 1e-6;
}

bool is_positive(const Vector3& v)
{
    return *std::min_element(v.begin(), v.end()) > 0;
}

Xy light_of(const ColorMatrix& matrix)
{
    const Xy* const known = xy_of_light_source(matrix.illuminant);
    return known ? *known : kD65;
}

/// What a camera cannot see of its own light is no matrix.
bool is_usable(const ColorMatrix& matrix)
{
    return is_invertible(matrix.xyz_to_camera) && is_positive(product(matrix.xyz_to_camera, xyz_of(light_of(matrix))));
}

bool has_forward(const ColorMatrix& matrix)
{
    return is_invertible(matrix.forward) && is_positive(product(matrix.forward, Vector3{ 1, 1, 1 }));
}

/// One matrix, or two of different lights, the warmer one first.
std::vector<ColorMatrix> matrices_of(const CameraFacts& facts)
{
    std::vector<ColorMatrix> result;
    for (const ColorMatrix& matrix : facts.color_matrices)
        if (is_usable(matrix) && result.size() < 2)
            result.push_back(matrix);
    const auto temperature = [](const ColorMatrix& m) { return light_of_xy(light_of(m)).temperature; };
    if (result.size() == 2) {
        if (std::fabs(temperature(result[0]) - temperature(result[1])) < 50)
            result.pop_back();
        else if (temperature(result[0]) > temperature(result[1]))
            std::swap(result[0], result[1]);
    }
    return result;
}

/// How much the first of two matrices counts under a light.
float weight_of_warmer(const std::vector<ColorMatrix>& matrices, const Xy& light)
{
    if (matrices.size() < 2)
        return 1;
    const double warm = light_of_xy(light_of(matrices[0])).temperature,
                 cool = light_of_xy(light_of(matrices[1])).temperature;
    const double here = std::clamp(double(light_of_xy(light).temperature), warm, cool);
    return float((1 / here - 1 / cool) / (1 / warm - 1 / cool));
}

Matrix3 mix(const Matrix3& a, const Matrix3& b, float weight_of_a)
{
    Matrix3 result;
    for (std::size_t i = 0; i < 9; ++i)
        result[i] = a[i] * weight_of_a + b[i] * (1 - weight_of_a);
    return result;
}

Matrix3 xyz_to_camera_under(const std::vector<ColorMatrix>& matrices, const Xy& light)
{
    return mix(matrices.front().xyz_to_camera, matrices.back().xyz_to_camera, weight_of_warmer(matrices, light));
}

/// The light whose white the camera sees as this neutral: each step takes the matrix for the light of the last one.
Xy light_of_neutral(const std::vector<ColorMatrix>& matrices, const Vector3& neutral)
{
    Xy light = kD50;
    for (int i = 0; i < 30; ++i) {
        const Vector3 xyz = product(inverse(xyz_to_camera_under(matrices, light)), neutral);
        const Xy next = xy_of(xyz);
        const bool is_light = std::isfinite(next[0]) && next[0] > 0.05f && next[1] > 0.05f && next[0] + next[1] < 0.95f;
        if (!is_light)
            break;
        const float step = std::fabs(next[0] - light[0]) + std::fabs(next[1] - light[1]);
        light = next;
        if (step < 1e-6f)
            break;
    }
    return light;
}

/// Each row of XYZ scaled so that (1,1,1) becomes D50.
Matrix3 white_to_d50(const Matrix3& m)
{
    const Vector3 white = product(m, Vector3{ 1, 1, 1 }), d50 = xyz_of(kD50);
    return product(diagonal({ d50[0] / white[0], d50[1] / white[1], d50[2] / white[2] }), m);
}

} // namespace

bool has_camera_color(const CameraFacts& facts)
{
    return !matrices_of(facts).empty();
}

Vector3 neutral_under(const CameraFacts& facts, const Xy& light)
{
    Vector3 neutral = product(xyz_to_camera_under(matrices_of(facts), light), xyz_of(light));
    const float most = *std::max_element(neutral.begin(), neutral.end());
    for (float& value : neutral)
        value /= most;
    return neutral;
}

Matrix3 balanced_to_xyz(const CameraFacts& facts, const Vector3& neutral)
{
    const std::vector<ColorMatrix> matrices = matrices_of(facts);
    const bool forward = std::all_of(matrices.begin(), matrices.end(), has_forward);
    const Xy light = matrices.size() == 1 ? light_of(matrices[0]) : light_of_neutral(matrices, neutral);
    if (forward)
        return white_to_d50(mix(matrices.front().forward, matrices.back().forward, weight_of_warmer(matrices, light)));
    const Matrix3 xyz_to_camera = xyz_to_camera_under(matrices, light);
    const Vector3 white = matrices.size() == 1 ? product(xyz_to_camera, xyz_of(light)) : neutral;
    const Matrix3 to_xyz = product(inverse(xyz_to_camera), diagonal(white));
    return white_to_d50(product(adaptation(light, kD50), to_xyz));
}

Vector3 white_balance_of(const CameraFacts& facts, const std::array<double, 3>& means)
{
    Vector3 neutral = facts.as_shot_neutral;
    if (!is_positive(neutral))
        for (std::size_t c = 0; c < 3; ++c)
            neutral[c] = float(means[c] / means[1]);
    return { neutral[1] / neutral[0], 1, neutral[1] / neutral[2] };
}

Matrix3 balanced_to_srgb(const CameraFacts& facts)
{
    const ColorMatrix* matrix = facts.daylight_matrix();
    const Matrix3 srgb_to_camera = matrix ? product(matrix->xyz_to_camera, kSrgbToXyz) : Matrix3{};
    if (!matrix || std::abs(determinant(srgb_to_camera)) < 1e-9)
        return { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    // Rows of sRGB → camera that sum to 1 take white to white; so does the inverse.
    return inverse(row_normalized(srgb_to_camera));
}

} // namespace srisp
