// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <srisp/expected.h>

namespace srisp {

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
