// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace srisp {

/// Bytes of a row of `count` samples without gaps between them.
std::size_t packed_row_bytes(std::size_t count, int bits);

/// Appends samples as TIFF stores them in a little-endian file: 16 bits as they are, fewer from the highest bit of each
/// byte down, the last byte filled up with zeros.
void append_packed_row(const std::uint16_t* samples, std::size_t count, int bits, std::string& target);

/// Appends samples as float16 or float32.
void append_float_row(const float* samples, std::size_t count, int bits, std::string& target);

/// TIFF's predictor for floating point, in place: the bytes of a row of little-endian samples are ordered by their
/// weight, then each is made the difference to the one a pixel of `planes` samples before. [Adobe Photoshop TIFF
/// technical note 3]
void predict_float_row(unsigned char* row, std::size_t samples, std::size_t bytes_per_sample, std::size_t planes);

} // namespace srisp
