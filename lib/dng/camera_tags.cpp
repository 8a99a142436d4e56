// SPDX-License-Identifier: Apache-2.0
#include "dng/camera_tags.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/matrix3.h"
#include "raw_file/tiff_numbers.h"

namespace srisp {

namespace {

using namespace tiff_tag;
constexpr int kD65 = 21; // EXIF LightSource

using ColorMatrix = CameraFacts::ColorMatrix;

std::string unique_model(const CameraFacts& facts)
{
    if (facts.make.empty() && facts.model.empty())
        return "srisp neutral camera";
    if (facts.make.empty() || facts.model.compare(0, facts.make.size(), facts.make) == 0)
        return facts.model;
    return facts.model.empty() ? facts.make : facts.make + " " + facts.model;
}

bool usable(const ColorMatrix& matrix)
{
    const auto finite = [](float v) { return std::isfinite(v) && std::abs(v) < 1000; };
    return std::all_of(matrix.xyz_to_camera.begin(), matrix.xyz_to_camera.end(), finite) &&
           determinant(matrix.xyz_to_camera) != 0;
}

/// At most two, of different lights that are known; at least one. Daylight's is the last one: dcraw takes that.
std::vector<ColorMatrix> written_matrices(const CameraFacts& facts, std::vector<std::string>& notes)
{
    std::vector<ColorMatrix> matrices;
    const ColorMatrix* unknown = nullptr;
    for (const ColorMatrix& matrix : facts.color_matrices) {
        const bool known = matrix.illuminant > 0 && matrix.illuminant < 255; // 255: other
        if (!usable(matrix))
            notes.push_back("a colour matrix that has no inverse was left out");
        else if (!known)
            unknown = unknown ? unknown : &matrix;
        else if (matrices.size() < 2 && (matrices.empty() || matrices[0].illuminant != matrix.illuminant))
            matrices.push_back(matrix);
    }
    if (matrices.size() == 2 && matrices[0].illuminant == kD65)
        std::swap(matrices[0], matrices[1]);
    if (matrices.empty() && unknown) {
        matrices.push_back({ unknown->xyz_to_camera, kD65 });
        notes.push_back("the light of the camera's colour matrix is not known: D65 was assumed");
    }
    if (matrices.empty()) {
        matrices.push_back({ inverse(kSrgbToXyz), kD65 });
        notes.push_back("no colour matrix is known: the image's colours were taken as linear sRGB");
    }
    return matrices;
}

/// Camera RGB of the light D65, G = 1.
std::array<float, 3> daylight_neutral(const ColorMatrix& matrix)
{
    std::array<float, 3> neutral{};
    for (std::size_t row = 0; row < 3; ++row) // white of sRGB is D65
        for (std::size_t column = 0; column < 3; ++column) {
            const float* xyz = kSrgbToXyz.data() + column * 3;
            neutral[row] += matrix.xyz_to_camera[row * 3 + column] * (xyz[0] + xyz[1] + xyz[2]);
        }
    for (const std::size_t channel : { 0, 2, 1 })
        neutral[channel] /= neutral[1];
    return neutral;
}

bool can_be_neutral(const std::array<float, 3>& neutral)
{
    return std::all_of(neutral.begin(), neutral.end(), [](float v) { return v >= 1e-4f && v <= 1e4f; });
}

std::array<float, 3> written_neutral(const CameraFacts& facts, const ColorMatrix& daylight,
                                     std::vector<std::string>& notes)
{
    if (can_be_neutral(facts.as_shot_neutral))
        return facts.as_shot_neutral;
    const std::array<float, 3> neutral = daylight_neutral(daylight);
    notes.push_back("no as-shot neutral is known: daylight (D65) was assumed");
    return can_be_neutral(neutral) ? neutral : std::array<float, 3>{ 1, 1, 1 };
}

} // namespace

void set_camera_tags(const CameraFacts& facts, TiffFolderBytes& folder, std::vector<std::string>& notes)
{
    if (!facts.make.empty())
        folder.set_text(kMake, facts.make);
    if (!facts.model.empty())
        folder.set_text(kModel, facts.model);
    folder.set_text(kUniqueCameraModel, unique_model(facts));
    const bool orientation = facts.orientation >= 1 && facts.orientation <= 8;
    folder.set_shorts(kOrientation, { std::uint32_t(orientation ? facts.orientation : 1) });

    const std::vector<ColorMatrix> matrices = written_matrices(facts, notes);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        const auto& matrix = matrices[i].xyz_to_camera;
        folder.set_signed_rationals(std::uint16_t(kColorMatrix1 + i), { matrix.begin(), matrix.end() });
        folder.set_shorts(std::uint16_t(kCalibrationIlluminant1 + i), { std::uint32_t(matrices[i].illuminant) });
    }
    const auto has_forward = [](const ColorMatrix& m) { return m.forward != decltype(m.forward){}; };
    if (std::all_of(matrices.begin(), matrices.end(), has_forward)) // readers take both or none
        for (std::size_t i = 0; i < matrices.size(); ++i)
            folder.set_signed_rationals(std::uint16_t(kForwardMatrix1 + i),
                                        { matrices[i].forward.begin(), matrices[i].forward.end() });
    CameraFacts written;
    written.color_matrices = matrices;
    const std::array<float, 3> neutral = written_neutral(facts, *written.daylight_matrix(), notes);
    folder.set_rationals(kAsShotNeutral, { neutral.begin(), neutral.end() });
}

TiffFolderBytes exif_folder(const CameraFacts& facts)
{
    const auto known = [](float value) { return std::isfinite(value) && value > 0; };
    TiffFolderBytes folder;
    folder.set_undefined(kExifVersion, "0230");
    if (known(facts.exposure_time_s))
        folder.set_rationals(kExposureTime, { facts.exposure_time_s });
    if (known(facts.f_number))
        folder.set_rationals(kFNumber, { facts.f_number });
    if (known(facts.iso))
        folder.set_shorts(kIso, { std::uint32_t(std::lround(std::min(facts.iso, 65535.0f))) });
    return folder;
}

} // namespace srisp
