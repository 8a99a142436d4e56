// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

// Words for the stock oiiotool that do what it does not do rightly by itself: they turn images, and keep the
// orientation in outputs. All but `ensure` hold expressions, and stand behind it: an image may lack the attribute.

namespace srisp::tool::orientation {

using Words = std::vector<std::string>;

/// Gives the image on top the attribute, as it was or 1.
Words ensure();

/// What `--reorient` should do: oiiotool 2.4 takes orientations 5 and 7 for each other.
Words turn_upright();

/// Marks an image that goes to a PNG file, whose writer knows no orientation (base/png_orientation.h).
Words mark_for_png();
Words unmark();

/// Writes a small image to `path` if the image on top is to be turned: only oiiotool knows.
Words tell_turned(const std::string& path);

} // namespace srisp::tool::orientation
