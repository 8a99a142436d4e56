// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include <srisp/expected.h>
#include <srisp/export.h>

namespace srisp {

/// "xxh128:" and 32 hex digits: XXH3 with 128 bits and seed 0, as `xxh128sum` prints it.
std::string hash_of_bytes(const void* data, std::size_t size);

/// The same of a whole file; the error names it. Exported for our own OpenColorIO library.
SRISP_API Expected<std::string> hash_of_file(const std::string& path);

} // namespace srisp
