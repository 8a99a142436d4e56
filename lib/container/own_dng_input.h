// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "container/own_dng.h"

// How OpenImageIO's readers make of a DNG that srisp wrote the image that it was made from.

namespace srisp {

/// Of LibRaw's four filters: R, G in the rows of R, B, G in the rows of B.
using FilterFactors = std::array<float, 4>;

/// Asks the reader of RAW files for linear camera RGB as stored, black subtracted, by this demosaicing, in place of all
/// that `hints` ask of it: each filter times its factor, which LibRaw divides by the least of them, over `level`.
void ask_for_linear_rgb(const char* demosaic, int level, const FilterFactors& factors, OIIO::ImageSpec& hints);

/// Asks the reader of RAW files for linear camera RGB in [0,1], black subtracted, not balanced, demosaiced, as stored;
/// in place of all that `hints` ask of it. For integers.
void ask_for_camera_rgb(const OwnDng& dng, OIIO::ImageSpec& hints);

/// Asks the reader of TIFF files for the RAW image, which may not be the file's first. For floats, which LibRaw does
/// not read. What is returned must outlive the reader.
std::unique_ptr<OIIO::Filesystem::IOProxy> ask_for_main_image(const OwnDng& dng, const std::string& path,
                                                              OIIO::ImageSpec& hints);

/// Puts into the spec of an image that was asked for so what results say of themselves.
void describe_own_dng(const OwnDng& dng, OIIO::ImageSpec& spec);

} // namespace srisp
