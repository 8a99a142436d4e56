// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "model/safetensors_header.h"

namespace srisp {

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

/// Reads a whole file of at most `max_bytes`; `where` as above.
Expected<std::string> read_file(const std::string& path, std::uint64_t max_bytes, const std::string& where);

} // namespace srisp
