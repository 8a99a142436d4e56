// SPDX-License-Identifier: Apache-2.0
#include <srisp/metadata.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include <OpenImageIO/strutil.h>

#include "base/guarded.h"
#include "base/matrix3.h"
#include "record/private_facts.h"
#include "record/record.h"

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

/// Whether an attribute describes the encoding or the pixel values of the image that a result was made from.
bool describes_source(OIIO::string_view name)
{
    const std::initializer_list<const char*> prefixes = { attribute::kPrefix,
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
                                                          "CICP",
                                                          "colorInteropID",
                                                          "acesImageContainerFlag",
                                                          "openexr:acesImageContainerFlag",
                                                          "heif:",
                                                          "srisp:",
                                                          "whiteLuminance",
                                                          "adoptedNeutral" };
    return std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const char* prefix) { return Strutil::istarts_with(name, prefix); });
}

void set(OIIO::ImageSpec& spec, const char* name, const std::string& value)
{
    if (!value.empty())
        spec.attribute(name, value);
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

/// The source's own words; where the source is a result itself, those of its source.
std::string own_description(const OIIO::ImageSpec& spec)
{
    const std::string text = spec.get_string_attribute("ImageDescription");
    const auto record = find_record(text);
    return record ? record->description : text;
}

} // namespace

void mark_result(OIIO::ImageSpec& spec, Direction direction)
{
    const std::string description = own_description(spec);
    auto& attributes = spec.extra_attribs;
    for (auto attribute = attributes.begin(); attribute != attributes.end();)
        attribute = describes_source(attribute->name()) ? attributes.erase(attribute) : attribute + 1;
    erase_private_facts(spec);
    const bool reverse = direction == Direction::reverse;
    // The name is set directly: ImageSpec::set_colorspace knows only spaces for display.
    spec.attribute("oiio:ColorSpace", reverse ? kCameraColorSpace : "sRGB");
    if (reverse)
        set(spec, attribute::kColorSpace, kCameraColorSpace);
    set(spec, attribute::kSynthetic, synthetic_mark(direction));
    write_record(spec, { direction, "", description, "", "" });
}

void record_result(OIIO::ImageSpec& spec, const Parameters& parameters, const CameraFacts* camera, Direction direction)
{
    mark_result(spec, direction);
    set(spec, attribute::kModel, parameters.model_name);
    set(spec, attribute::kModelHash, parameters.model_hash);
    set(spec, attribute::kReference, parameters.reference_name);
    set(spec, attribute::kReferenceHash, parameters.reference_hash);
    if (direction == Direction::reverse) {
        const auto& [red, green, blue] = parameters.white_balance;
        const float neutral[3] = { green / red, 1, green / blue };
        spec.attribute(attribute::kNeutral, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3), neutral);
        if (camera) {
            write_camera(spec, *camera);
            if (const CameraFacts::ColorMatrix* matrix = camera->daylight_matrix())
                set_adopted_neutral(spec, matrix->xyz_to_camera, neutral);
        }
    }
    write_record(spec, { direction, to_json(parameters, -1), own_description(spec), "", "" });
}

Expected<Parameters> recorded_parameters(const OIIO::ImageSpec& spec, const std::string& where)
{
    return guarded("recorded parameters", {}, [&]() -> Expected<Parameters> {
        const auto record = read_record(spec);
        if (!record || record->parameters.empty())
            return Error{ where +
                          ": holds no recorded parameters (srisp did not make it, or its ImageDescription is gone)" };
        return parameters_from_json(record->parameters, where + ": recorded parameters");
    });
}

bool is_unprocessed(const OIIO::ImageSpec& spec)
{
    const auto record = read_record(spec);
    return record && record->direction == Direction::reverse;
}

} // namespace srisp
