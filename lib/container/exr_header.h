// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Whether the attributes in the headers of an OpenEXR file lie within the file. OpenEXR takes memory for each as it
/// says, up to 2 GB, before it finds that the file ends. Errors, without the file's name: one that does not. What is no
/// such file is left to the reader.
Status check_exr_header(const std::string& path);

} // namespace srisp
