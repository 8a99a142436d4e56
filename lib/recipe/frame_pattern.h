// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// The path with the frame wildcard of its last part as printf has it: `p.#.json` → `p.%04d.json`. As in oiiotool a '#'
/// is four digits.
std::string frame_pattern_of_file(const std::string& path);

/// Where the frame wildcard of an image's name on oiiotool's command line is: runs of '#' and '@' (one digit), or %04d,
/// with the range that may stand before it: the `1-9@@` of `s.1-9@@.tif`. As oiiotool finds it, in the last part of the
/// path only.
struct FrameWildcard {
    std::size_t begin = 0;
    std::size_t length = 0; ///< 0: there is none
    bool has_range = false;
};
FrameWildcard find_frame_wildcard(const std::string& path);

/// The same as frame_pattern_of_file for such a name: `s.1-9@@.tif` → `s.%02d.tif`.
std::string frame_pattern_of_image(const std::string& path);

/// `pattern` with a run of '#' or one %d, %0Nd replaced by the frame number, padded with zeros. Here a '#' is one
/// digit. No frame: the pattern as it is.
std::string with_frame(const std::string& pattern, const std::string& frame);

} // namespace srisp
