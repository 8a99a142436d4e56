// SPDX-License-Identifier: Apache-2.0
#include "camera/dng_camera.h"

#include <algorithm>
#include <cmath>

#include "raw_file/tiff_numbers.h"
#include "raw_file/tiff_tags.h"

namespace srisp {

namespace {

using namespace tiff_tag;

/// Looks a tag up where writers put it: the first folder, the main image's, the Exif folder.
class CameraTags {
public:
    CameraTags(const TiffTags& tags, const TiffFolder& image) : m_tags(tags), m_image(image) {}

    std::vector<double> values(std::uint16_t tag) const
    {
        for (const TiffFolder* folder : { &m_tags.folders()[0], &m_image, &m_tags.exif() }) {
            std::vector<double> found = m_tags.values(*folder, tag);
            const bool finite = std::all_of(found.begin(), found.end(), [](double v) { return std::isfinite(v); });
            if (!found.empty() && finite)
                return found;
        }
        return {};
    }
    float value(std::uint16_t tag) const
    {
        const std::vector<double> found = values(tag);
        return found.empty() ? 0 : float(found[0]);
    }

private:
    const TiffTags& m_tags;
    const TiffFolder& m_image;
};

/// Whether a matrix changes each channel alone.
bool is_diagonal(const std::vector<double>& m)
{
    return m[1] == 0 && m[2] == 0 && m[3] == 0 && m[5] == 0 && m[6] == 0 && m[7] == 0;
}

/// XYZ → camera = analog balance · camera calibration · colour matrix [DNG 1.4, chapter 6]. A forward matrix takes
/// balanced values, which a calibration that is diagonal does not change; others are rare, and have none then.
void add_color_matrix(const CameraTags& tags, int index, CameraFacts& facts)
{
    const std::vector<double> color = tags.values(std::uint16_t(kColorMatrix1 + index));
    if (color.size() != 9)
        return;
    std::vector<double> calibration = tags.values(std::uint16_t(kCameraCalibration1 + index));
    if (calibration.size() != 9)
        calibration = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    std::vector<double> balance = tags.values(kAnalogBalance);
    if (balance.size() != 3)
        balance = { 1, 1, 1 };
    CameraFacts::ColorMatrix matrix;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k)
                sum += balance[row] * calibration[row * 3 + k] * color[k * 3 + column];
            matrix.xyz_to_camera[row * 3 + column] = float(sum);
        }
    matrix.illuminant = int(std::clamp(tags.value(std::uint16_t(kCalibrationIlluminant1 + index)), 0.0f, 255.0f));
    const std::vector<double> forward = tags.values(std::uint16_t(kForwardMatrix1 + index));
    if (forward.size() == 9 && is_diagonal(calibration))
        std::copy(forward.begin(), forward.end(), matrix.forward.begin());
    facts.color_matrices.push_back(matrix);
}

} // namespace

void describe_dng_camera(const TiffTags& tags, const TiffFolder& image, CameraFacts& facts)
{
    const CameraTags camera(tags, image);
    const TiffFolder& first = tags.folders()[0];
    facts.make = tags.text(first, kMake);
    facts.model = tags.text(first, kModel);
    if (facts.model.empty())
        facts.model = tags.text(first, kUniqueCameraModel);
    const int orientation = int(std::clamp(camera.value(kOrientation), 0.0f, 9.0f));
    facts.orientation = orientation >= 1 && orientation <= 8 ? orientation : 1;
    add_color_matrix(camera, 0, facts);
    add_color_matrix(camera, 1, facts);
    const std::vector<double> neutral = camera.values(kAsShotNeutral);
    if (neutral.size() == 3 && *std::min_element(neutral.begin(), neutral.end()) > 0)
        facts.as_shot_neutral = { float(neutral[0] / neutral[1]), 1, float(neutral[2] / neutral[1]) };
    facts.iso = camera.value(kIso);
    facts.exposure_time_s = camera.value(kExposureTime);
    facts.f_number = camera.value(kFNumber);
    facts.noise_profile = camera.values(kNoiseProfile);
}

} // namespace srisp
