// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// The path with the frame wildcard of its last part as printf has it: `p.#.json` → `p.%04d.json`. As in oiiotool a '#'
/// is four digits.
std::string frame_pattern_of_file(const std::string& path);

/// The same for the name of an image on oiiotool's command line, which may also use '@' (one digit) and begin the
/// wildcard with a range: `s.1-9@@.tif` → `s.%02d.tif`.
std::string frame_pattern_of_image(const std::string& path);

/// `pattern` with a run of '#' or one %d, %0Nd replaced by the frame number, padded with zeros. Here a '#' is one
/// digit. No frame: the pattern as it is.
std::string with_frame(const std::string& pattern, const std::string& frame);

} // namespace srisp
