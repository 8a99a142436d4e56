// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// What is wrong with a JPEG file that its reader warns of.
struct JpegDamage {
    bool pixels_missing = false; ///< otherwise the whole picture is there
    std::string text;            ///< libjpeg's words
};

/// Decodes the file once more, and looks at each warning. Stray bytes between segments and a missing end marker cost no
/// pixels; data that breaks off, scans of a progressive file that are not there, and codes that stand for nothing do.
JpegDamage find_jpeg_damage(const std::string& path);

} // namespace srisp
