// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include <srisp/expected.h>

namespace srisp {

/// The image of a gain map, 8 bits a value.
struct GainMapImage {
    int width = 0, height = 0;
    int channels = 0; ///< 1, or 3: R, G, B
    std::vector<unsigned char> values;

    const unsigned char* row(int y) const { return values.data() + std::size_t(y) * width * channels; }
};

/// Decodes a JPEG of a gain map. Errors start with "its gain map": damaged or truncated, colours that are neither grey
/// nor RGB, more than 64 Mpx.
Expected<GainMapImage> decode_gain_map_image(std::string_view jpeg);

} // namespace srisp
