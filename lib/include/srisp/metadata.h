// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>
#include <srisp/apply.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/parameters.h>
#include <srisp/reference.h>

namespace srisp {

/// Writes into `spec` what a result says of itself, in the forms that survive EXR, TIFF, PNG and JPEG: a plain mark
/// that the image is synthetic, parameters and hashes (ImageDescription as one JSON line, and `unprocess:*`), the
/// reference's camera facts (XYZ→camera matrix, adoptedNeutral) and a colour-space name that no program takes for
/// linear sRGB. `reference` may be null where parameters were given instead of one. `Direction::forward` marks an sRGB
/// result.
SRISP_API void record_result(OIIO::ImageSpec& spec, const Parameters& parameters, const Reference* reference,
                             Direction direction);

/// Takes the parameters that `record_result` left in an image. Error: none there, or they are damaged. `where`: the
/// image's name in messages.
SRISP_API Expected<Parameters> recorded_parameters(const OIIO::ImageSpec& spec, const std::string& where);

/// Whether the image says that srisp made it by `Direction::reverse`.
SRISP_API bool is_unprocessed(const OIIO::ImageSpec& spec);

} // namespace srisp
