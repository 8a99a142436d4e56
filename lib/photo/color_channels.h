// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

namespace srisp {

/// Which channels of an image are its colour.
struct ColorChannels {
    std::vector<int> color;  ///< R, G, B, or one grey channel
    int alpha = -1;          ///< or −1
    std::vector<int> others; ///< neither colour nor alpha, in the image's order
};

/// Finds them by name: R, G, B (also as "layer.R", …), else the only channel that is neither alpha nor depth. Errors:
/// CMYK and other colour models (also where the reader has converted them to RGB without colour management), no colour.
Expected<ColorChannels> find_color_channels(const OIIO::ImageSpec& spec, const std::string& where);

} // namespace srisp
