// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <OpenImageIO/imageio.h>

namespace srisp::plugin {

/// An XMP packet that says what a result is: synthetic, by which program, model and reference. Empty for an image that
/// records none of it. [XMP part 1; IPTC: digital source type]
std::string xmp_of(const OIIO::ImageSpec& spec);

} // namespace srisp::plugin
