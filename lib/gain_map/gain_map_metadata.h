// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include <srisp/expected.h>

#include "gain_map/xmp_packet.h"

namespace srisp {

/// What the values of a gain map mean, for R, G, B. Of the same meaning in Ultra HDR and in ISO 21496-1.
struct GainMapMetadata {
    std::array<double, 3> min{}, max{};               ///< log2 of the boost where the map is 0, is 1
    std::array<double, 3> gamma{ 1, 1, 1 };           ///< exponent that the map was encoded with
    std::array<double, 3> offset_sdr{}, offset_hdr{}; ///< added to linear light before the boost
    double sdr_headroom = 0, hdr_headroom = 0;        ///< log2 of the display's white over SDR white
    bool base_is_hdr = false;                         ///< the photo itself is the HDR picture
    bool in_colors_of_base = true; ///< the boost counts in the photo's own primaries, not in the HDR picture's
};

/// `hdrgm:Version` stands in the photo and in the map's image.
extern const XmpName kGainMapVersion;

/// Of the map image's XMP (hdrgm:…). Errors start with "its gain map": absent or no numbers, of a version that is not
/// known, numbers that cannot be meant.
Expected<GainMapMetadata> gain_map_metadata_from_xmp(const XmpPacket& xmp);

/// Of the map image's segment of ISO 21496-1, after its name. The same errors, and: cut.
Expected<GainMapMetadata> gain_map_metadata_from_iso(std::string_view segment);

} // namespace srisp
