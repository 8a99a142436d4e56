// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace srisp {

/// "xxh64:" and 16 hex digits: XXH64 with seed 0, as `xxh64sum` prints it. Faster than a disk reads. Own code, since
/// packs must be readable where there is no libxxhash. (https://github.com/Cyan4973/xxHash, doc/xxhash_spec.md)
std::string xxh64_of_bytes(const void* data, std::size_t size);

} // namespace srisp
