// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

#include "base/file_bytes.h"

namespace srisp {

/// What a TIFF holds that is a camera's RAW file by its tags (a mosaic, LinearRaw, a camera's own compression), for
/// messages: "a RAW file of 'NIKON Z 9' (TIFF with a mosaic, compression 34713)". Empty for other files: they may be
/// photos.
std::string tiff_raw_name(const FileBytes& file);

/// Refuses compressions that LibRaw does not know but would take for others.
Status check_tiff_raw(const FileBytes& file);

/// The message about VC-5, in a DNG or not.
std::string undecoded_vc5();

} // namespace srisp
