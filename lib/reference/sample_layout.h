// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "reference/raw_pixels.h"

namespace srisp {

/// How plain samples without a header lie in a file, as a JSON file beside it says.
struct SampleLayout {
    std::string path, text; ///< of the description
    RawPixels pixels;       ///< width, height, filters and levels; no samples yet
    CameraFacts facts;
    int bits = 16;
    bool packed = false; ///< as MIPI CSI-2 does: 4 samples of 10 bits in 5 bytes, 2 of 12 in 3
    std::uint64_t offset = 0, row_bytes = 0;
};

/// Reads the first of layout_paths that exists (nothing if none does). Errors begin with the description's name: not
/// JSON, unknown or missing keys (the near ones listed), values that cannot be.
Expected<std::optional<SampleLayout>> find_sample_layout(const std::string& path);

/// The same for a file in which neither we nor LibRaw know a header: an error that says what to do where none exists.
Expected<SampleLayout> needed_sample_layout(const std::string& path);

/// Reads a description from its text.
Expected<SampleLayout> parse_sample_layout(const std::string& text, const std::string& path);

} // namespace srisp
