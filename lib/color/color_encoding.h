// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/colorimetry.h"
#include "color/color_transform.h"

namespace srisp {

/// From linear light to stored values.
enum class Transfer {
    srgb,   ///< IEC 61966-2-1; also taken for BT.709's and BT.601's, since that is how such pictures are looked at
    linear, ///< none
    power,  ///< linear light to the power of 1/gamma
    pq,     ///< SMPTE ST 2084
    hlg     ///< BT.2100 hybrid log-gamma
};

/// How an RGB image stores colour, where no profile says it.
struct ColorEncoding {
    Transfer transfer = Transfer::srgb;
    float gamma = 1; ///< of Transfer::power
    Chromaticities chromaticities = kSrgbChromaticities;
};

/// What a name that readers, OpenColorIO configurations and cameras use says.
struct NamedEncoding {
    ColorEncoding encoding;
    bool says_primaries; ///< otherwise the file may have chromaticities of its own
};
/// None: the name is not known.
std::optional<NamedEncoding> named_encoding(const std::string& name);

/// What the four numbers of a CICP description say [ITU-T H.273]; `notes`: what of it is not known and what was taken
/// instead. None: nothing (both colour numbers are "unspecified").
std::optional<ColorEncoding> cicp_encoding(const std::array<int, 4>& cicp, std::vector<std::string>& notes);

/// Whether these are the corners of a colour space at all.
bool are_usable(const Chromaticities& chromaticities);

/// The transform to display-encoded sRGB, white to white (Bradford); null where it is the identity. A linear encoding
/// takes unbounded values. `channels`: of colour in the image; grey has no primaries.
ColorTransformPtr transform_of(const ColorEncoding& encoding, int channels);

} // namespace srisp
