// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace srisp {

/// Interleaved samples of `components` (1 to 4) a column, all below 2^bits, one row after the other.
struct JpegSamples {
    const std::uint16_t* values;
    int columns, rows; ///< 1 to 65535
    int components;
    int bits; ///< 2 to 16
};

/// A lossless JPEG: process 14, predictor 1, a Huffman code of its own for each component. [T.81 annex H] A mosaic is
/// best given as two components a column, neighbours in a row, as they have different colours.
std::string encode_lossless_jpeg(const JpegSamples& samples);

} // namespace srisp
