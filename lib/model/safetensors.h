// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "base/regular_file.h"

namespace srisp {

/// Where a tensor lies in a safetensors file.
struct TensorEntry {
    std::string name, type;
    std::vector<std::int64_t> shape;
    std::uint64_t begin, end; ///< bytes after the header
};

/// The header of a safetensors file, checked against the file's size.
struct SafeTensorsHeader {
    std::vector<TensorEntry> entries; ///< in the order in which they lie in the file, without gaps
    std::map<std::string, std::string> metadata;
    std::uint64_t data_begin = 0; ///< bytes before the first tensor
};

/// Bytes of an element of type "F64", "F32", "U16", …; 0 for a type that there is not.
std::uint64_t safetensors_element_size(const std::string& type);

/// "[3, 24]", for messages.
std::string shape_text(const std::vector<std::int64_t>& shape);

/// Parses the header of a file of `size` bytes, which is at `bytes`; no tensor is touched. `types`: those
/// that may occur. `where` starts every message ("model 'm.safetensors'"). Errors: header length beyond the file, not
/// JSON, duplicate names, offsets outside the file, overlapping or with gaps, sizes that do not match shape and type,
/// other types. (https://github.com/huggingface/safetensors, format)
Expected<SafeTensorsHeader> parse_safetensors_header(const char* bytes, std::uint64_t size,
                                                     const std::vector<std::string>& types, const std::string& where);

/// The same of a file on disk, of which no more is read.
Expected<SafeTensorsHeader> read_safetensors_header(const RegularFile& file, const std::vector<std::string>& types,
                                                    const std::string& where);

/// A tensor as float32, row-major.
struct Tensor {
    std::vector<std::int64_t> shape;
    std::vector<float> values;
};

/// A safetensors file: named tensors and the texts of `__metadata__`.
struct SafeTensors {
    std::map<std::string, Tensor> tensors;
    std::map<std::string, std::string> metadata;
};

/// Parses a safetensors file that is in memory: F32, F16 and BF16 tensors. `where` starts every message ("model
/// 'm.safetensors'"). Errors: those of parse_safetensors_header.
Expected<SafeTensors> parse_safetensors(const std::string& bytes, const std::string& where);

/// A tensor to be written; the values stay the caller's, row-major, little-endian.
struct TensorView {
    std::string name;
    std::string type; ///< F64 F32 F16 BF16 I64 I32 I16 I8 U16 U8 BOOL
    std::vector<std::int64_t> shape;
    const void* data;
};

/// Writes a safetensors file: whole or not at all. Widest types first, so that each tensor lies on a multiple of its
/// element's size (the data begin on a multiple of 8); of one type in the order given. Same bytes for the same input.
/// Errors, as `'path' …`: an unknown type, a name twice, the disk's own.
Status write_safetensors(const std::string& path, std::vector<TensorView> tensors,
                         const std::map<std::string, std::string>& metadata);

} // namespace srisp
