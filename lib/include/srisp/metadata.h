// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/camera.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/options.h>
#include <srisp/parameters.h>

// What a result says of itself, in forms that survive OpenImageIO's EXR, TIFF, PNG and JPEG writers: ImageDescription
// as one JSON line, and attributes `unprocess:*`. (Not `srisp:*`: writers drop the prefixes of other loaded formats.)

namespace srisp {

/// `oiio:ColorSpace` and `unprocess:colorspace` of a RAW-like result: linear camera RGB, which is not linear sRGB.
constexpr const char* kCameraColorSpace = "camera_rgb";

/// Writes what holds before the parameters are known: the plain mark that the image is synthetic and the name of its
/// colour space; erases what described the encoding or the pixels of the source (ICC profile, Exif:ColorSpace, gamma,
/// chromaticities, checksums, …), what srisp recorded of an earlier step, and what is private: where the source was
/// taken, serial numbers, owners, identifiers (docs/privacy.md).
SRISP_API void mark_result(OIIO::ImageSpec& spec, Direction direction);

/// `mark_result`, then parameters, names and hashes, and for `Direction::reverse` the reference's camera facts
/// (XYZ→camera matrix, levels, …) and adoptedNeutral. `camera` may be null where parameters were given instead of a
/// reference. The source's own ImageDescription is kept inside ours.
SRISP_API void record_result(OIIO::ImageSpec& spec, const Parameters& parameters, const CameraFacts* camera,
                             Direction direction);

/// Takes the parameters that `record_result` left in an image. Error: none there, or they are damaged. `where`: the
/// image's name in messages.
SRISP_API Expected<Parameters> recorded_parameters(const OIIO::ImageSpec& spec, const std::string& where);

/// Which filters lie over pixel (0, 0) of a mosaic, its right neighbour and the two below: "RGGB", …; empty: the image
/// is no mosaic, or does not say. The second function says so of an image of one channel; empty: it says nothing any
/// more.
SRISP_API std::string recorded_cfa_pattern(const OIIO::ImageSpec& spec);
SRISP_API void record_cfa_pattern(OIIO::ImageSpec& spec, const std::string& pattern);

/// Whether the image says that srisp made it by `Direction::reverse`.
SRISP_API bool is_unprocessed(const OIIO::ImageSpec& spec);

} // namespace srisp
