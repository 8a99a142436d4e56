// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace srisp {

/// 64 hex digits, as `sha256sum` prints them. [FIPS 180-4] Own code: no library that we load has it.
std::string sha256_of_bytes(const void* data, std::size_t size);

/// The same without the processor's instructions for it.
std::string sha256_of_bytes_plain(const void* data, std::size_t size);

} // namespace srisp
