// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

#include "container/file_type.h"

namespace srisp {

/// What a reference's file is: by its first bytes, but that plain samples may begin with the two bytes of a BMP. So
/// what is called RAW and described is no photo. Errors, without the file's name: those of read_head.
Expected<FileType> reference_type(const std::string& path);

} // namespace srisp
