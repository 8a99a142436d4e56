// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// What the first bytes of a file say of its being a DNG.
enum class DngHead {
    no,
    yes,
    unknown ///< a TIFF whose first folder of tags lies further on
};

/// Reads little, as TIFFs may be huge. A file that cannot be read is none.
DngHead dng_head(const std::string& path);

} // namespace srisp
