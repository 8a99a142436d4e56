// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <srisp/expected.h>

namespace srisp {

/// What the frame header of a JPEG says.
struct JpegHeader {
    int process = 0; ///< n of its marker SOFn: 0, 1, 2 are DCT (lossy), 3 is lossless
    int bits = 0, width = 0, height = 0, components = 0;

    bool lossy() const { return process <= 2; }
};

/// Finds the frame header among the markers; nothing if the bytes are no JPEG.
std::optional<JpegHeader> jpeg_header(const unsigned char* data, std::size_t size);

/// Decodes a lossy JPEG of 8 bits that `header` describes: rows of `width` pixels of `components` (1, or 3: R, G, B)
/// bytes. Errors: damaged or truncated data.
Expected<std::vector<unsigned char>> decode_jpeg(const unsigned char* data, std::size_t size, const JpegHeader& header);

} // namespace srisp
