// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// OpenEXR takes as much memory for an attribute as the file says that it has: whether all lie within the file. Errors:
/// "is damaged or truncated: …". Other damage is left to the reader, which tells it.
Status check_exr_header(const std::string& path);

} // namespace srisp
