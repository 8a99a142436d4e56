// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <srisp/expected.h>

#include "gain_map/gain_map_metadata.h"

namespace srisp {

/// The gain map that a photo holds: with it the photo is a picture in high dynamic range.
struct GainMapInfo {
    enum class Kind {
        ultra_hdr, ///< Ultra HDR 1 (Adobe's gain map): its metadata is XMP
        iso,       ///< ISO 21496-1
        apple,     ///< Apple's own: found, but neither `metadata` nor `jpeg` is given
    };
    Kind kind;
    GainMapMetadata metadata;
    std::string jpeg; ///< the file that the map's image is

    std::string name() const; ///< of the kind
};

/// The gain map of a JPEG file in memory; none: it holds none, or is no JPEG. Errors start with "its gain map": the
/// photo says that it has one, and it is not there (programs that do not know of it cut it off); bad metadata. The
/// map's image is not decoded yet.
Expected<std::optional<GainMapInfo>> find_gain_map(std::string_view file);

/// That of a file on disk. Errors: the same, without its name, and why it cannot be read; of others than JPEG the first
/// bytes are read only.
Expected<std::optional<GainMapInfo>> find_gain_map_of_file(const std::string& path);

} // namespace srisp
