// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <srisp/expected.h>

#include "base/regular_file.h"

namespace srisp {

/// "xxh128:" and 32 hex digits: XXH3 with 128 bits and seed 0, as `xxh128sum` prints it.
std::string hash_of_bytes(const void* data, std::size_t size);

/// The same of a whole file; the error names it.
Expected<std::string> hash_of_file(const std::string& path);

/// "xxh64:" and 16 hex digits: XXH64 with seed 0, as `xxh64sum` prints it. Faster than a disk reads. Own code, since
/// packs must be readable where there is no libxxhash. (https://github.com/Cyan4973/xxHash, doc/xxhash_spec.md)
std::string xxh64_of_bytes(const void* data, std::size_t size);

/// The same of a whole file. Errors, without the file's name: the disk's own; it was made shorter meanwhile.
Expected<std::string> xxh64_of_file(const RegularFile& file);

/// A number that looks random and depends on seed and text alone: the same on every machine and library, which
/// std::hash and the distributions of <random> do not promise. (FNV-1a, then SplitMix64.)
std::uint64_t seeded_hash(std::uint64_t seed, const std::string& text);

} // namespace srisp
