// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Opens and unpacks a file as other programs do with LibRaw, and throws the samples away. Errors, without the file's
/// name: it cannot be read, those of check_libraw_traps, what LibRaw says.
Status try_libraw(const std::string& path);

} // namespace srisp
