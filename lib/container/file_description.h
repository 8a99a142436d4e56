// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

// What a file says about its picture beyond what OpenImageIO's reader hands over, put into the picture's spec.

namespace srisp {

/// Notes about a file travel in its spec, which no writer writes.
void add_note(OIIO::ImageSpec& spec, const std::string& note);
std::vector<std::string> note_list(const OIIO::ImageSpec& spec);
void erase_notes(OIIO::ImageSpec& spec);

/// These replace what the spec said of its colour.
void set_icc_profile(OIIO::ImageSpec& spec, const void* profile, std::size_t size);
void set_cicp(OIIO::ImageSpec& spec, const std::array<int, 4>& cicp);
/// `name` as `oiio:ColorSpace`.
void set_color_space(OIIO::ImageSpec& spec, const std::string& name);
/// Linear light to the power of 1/gamma.
void set_gamma(OIIO::ImageSpec& spec, double gamma);

/// xy of red, green, blue and white; beside a name or a gamma.
void set_chromaticities(OIIO::ImageSpec& spec, const std::array<float, 8>& chromaticities);

/// Adds what an EXIF block (TIFF, without "Exif\0\0") says and the spec does not.
void add_exif(OIIO::ImageSpec& spec, const void* exif, std::size_t size);

// By container. A file that cannot be followed leaves the spec as it is: its reader has said what is wrong.
void describe_png(const std::string& path, OIIO::ImageSpec& spec);
void describe_heif(const std::string& path, OIIO::ImageSpec& spec);
void describe_bmp(const std::string& path, OIIO::ImageSpec& spec);
void describe_psd(const std::string& path, OIIO::ImageSpec& spec);

} // namespace srisp
