// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Checks what a file says of its picture's size before a reader is opened that takes memory and time by it then: those
/// of BMP with runs, GIF, HEIF, JPEG, JPEG 2000 and interlaced PNG, of OpenEXR the sizes of attributes, of DPX that of
/// the user's data. Nothing is decoded. Files of other readers, and those in which no size is found, are left to the
/// reader. The size itself: check_claim; of a JPEG its scans, too, each of which costs a pass over the whole picture.
Status check_header(const std::string& reader, const std::string& path);

} // namespace srisp
