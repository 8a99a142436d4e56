// SPDX-License-Identifier: Apache-2.0
#include <srisp/metadata.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <OpenImageIO/strutil.h>

#include "base/matrix3.h"
#include "record/record_line.h"

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

const char kPrefix[] = "unprocess:";

/// Whether an attribute describes the encoding or the pixel values of the image that a result was made from.
bool describes_source(OIIO::string_view name)
{
    const std::initializer_list<const char*> prefixes = { kPrefix,
                                                          "ICCProfile",
                                                          "Exif:ColorSpace",
                                                          "Exif:Gamma",
                                                          "oiio:Gamma",
                                                          "oiio:ColorSpace",
                                                          "oiio:BitsPerSample",
                                                          "oiio:UnassociatedAlpha",
                                                          "oiio:SHA-1",
                                                          "oiio:ConstantColor",
                                                          "oiio:AverageColor",
                                                          "oiio:subimages",
                                                          "jpeg:",
                                                          "gif:",
                                                          "png:",
                                                          "tiff:PhotometricInterpretation",
                                                          "tiff:ColorSpace",
                                                          "photoshop:ICCProfile",
                                                          "photoshop:ColorMode",
                                                          "crs:",
                                                          "chromaticities",
                                                          "whiteLuminance",
                                                          "adoptedNeutral" };
    return std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const char* prefix) { return Strutil::istarts_with(name, prefix); });
}

void set(OIIO::ImageSpec& spec, const std::string& name, const std::string& value)
{
    if (!value.empty())
        spec.attribute(kPrefix + name, value);
}

void set(OIIO::ImageSpec& spec, const std::string& name, float value)
{
    if (value > 0)
        spec.attribute(kPrefix + name, value);
}

void set(OIIO::ImageSpec& spec, const std::string& name, const float* values, int count)
{
    spec.attribute(kPrefix + name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, count), values);
}

/// CIE xy of the camera RGB that is neutral in the result (OpenEXR's meaning of the attribute).
void set_adopted_neutral(OIIO::ImageSpec& spec, const Matrix3& xyz_to_camera, const float neutral[3])
{
    if (std::fabs(determinant(xyz_to_camera)) < 1e-9)
        return;
    const Matrix3 to_xyz = inverse(xyz_to_camera);
    float xyz[3];
    for (int row = 0; row < 3; ++row)
        xyz[row] = to_xyz[row * 3] * neutral[0] + to_xyz[row * 3 + 1] * neutral[1] + to_xyz[row * 3 + 2] * neutral[2];
    const float sum = xyz[0] + xyz[1] + xyz[2];
    const float xy[2] = { xyz[0] / sum, xyz[1] / sum };
    if (xy[0] > 0 && xy[1] > 0 && xy[0] + xy[1] < 1)
        spec.attribute("adoptedNeutral", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::VEC2), xy);
}

void record_facts(OIIO::ImageSpec& spec, const CameraFacts& facts, const float neutral[3])
{
    set(spec, "reference_make", facts.make);
    set(spec, "reference_model", facts.model);
    set(spec, "reference_cfa_pattern", facts.cfa_pattern);
    set(spec, "reference_iso", facts.iso);
    set(spec, "reference_exposure_time", facts.exposure_time_s);
    set(spec, "reference_f_number", facts.f_number);
    set(spec, "reference_white_level", facts.white_level);
    if (facts.white_level > 0)
        set(spec, "reference_black_level", facts.black_level.data(), 4);
    if (facts.as_shot_neutral[1] > 0)
        set(spec, "reference_as_shot_neutral", facts.as_shot_neutral.data(), 3);
    if (!facts.noise_profile.empty()) {
        const std::vector<float> noise(facts.noise_profile.begin(), facts.noise_profile.end());
        set(spec, "reference_noise_profile", noise.data(), static_cast<int>(noise.size()));
    }
    if (const CameraFacts::ColorMatrix* matrix = facts.daylight_matrix()) {
        spec.attribute(std::string(kPrefix) + "xyz_to_camera", OIIO::TypeMatrix33, matrix->xyz_to_camera.data());
        if (matrix->illuminant)
            spec.attribute(std::string(kPrefix) + "xyz_to_camera_illuminant", matrix->illuminant);
        set_adopted_neutral(spec, matrix->xyz_to_camera, neutral);
    }
}

/// The record in an image; ImageDescription is what most formats keep.
bool read_record(const OIIO::ImageSpec& spec, RecordLine& record)
{
    return find_record(spec.get_string_attribute(std::string(kPrefix) + "record"), record) ||
           find_record(spec.get_string_attribute("ImageDescription"), record);
}

/// The source's own words; where the source is a result itself, those of its source.
std::string own_description(const OIIO::ImageSpec& spec)
{
    RecordLine record;
    const std::string text = spec.get_string_attribute("ImageDescription");
    return find_record(text, record) ? record.description : text;
}

void write_record(OIIO::ImageSpec& spec, const RecordLine& record)
{
    const std::string line = format_record(record);
    spec.attribute("ImageDescription", line);
    // Captions get edited; EXR keeps this one as well.
    set(spec, "record", line);
}

} // namespace

void mark_result(OIIO::ImageSpec& spec, Direction direction)
{
    const std::string description = own_description(spec);
    auto& attributes = spec.extra_attribs;
    for (auto attribute = attributes.begin(); attribute != attributes.end();)
        attribute = describes_source(attribute->name()) ? attributes.erase(attribute) : attribute + 1;
    const bool reverse = direction == Direction::reverse;
    // The name is set directly: ImageSpec::set_colorspace knows only spaces for display.
    spec.attribute("oiio:ColorSpace", reverse ? kCameraColorSpace : "sRGB");
    if (reverse)
        set(spec, "colorspace", kCameraColorSpace);
    set(spec, "synthetic", synthetic_mark(direction));
    write_record(spec, { direction, "", description });
}

void record_result(OIIO::ImageSpec& spec, const Parameters& parameters, const CameraFacts* camera, Direction direction)
{
    mark_result(spec, direction);
    set(spec, "model", parameters.model_name);
    set(spec, "model_hash", parameters.model_hash);
    set(spec, "reference", parameters.reference_name);
    set(spec, "reference_hash", parameters.reference_hash);
    if (direction == Direction::reverse) {
        const auto& [red, green, blue] = parameters.white_balance;
        const float neutral[3] = { green / red, 1, green / blue };
        set(spec, "neutral", neutral, 3);
        if (camera)
            record_facts(spec, *camera, neutral);
    }
    write_record(spec, { direction, to_json(parameters, -1), own_description(spec) });
}

Expected<Parameters> recorded_parameters(const OIIO::ImageSpec& spec, const std::string& where)
{
    RecordLine record;
    if (!read_record(spec, record) || record.parameters.empty())
        return Error{ where +
                      ": holds no recorded parameters (srisp did not make it, or its ImageDescription is gone)" };
    return parameters_from_json(record.parameters, where + ": recorded parameters");
}

bool is_unprocessed(const OIIO::ImageSpec& spec)
{
    RecordLine record;
    return read_record(spec, record) && record.direction == Direction::reverse;
}

} // namespace srisp
