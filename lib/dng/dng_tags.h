// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/dng.h>

#include "dng/image_blocks.h"
#include "dng/tiff_folder.h"

namespace srisp {

/// Sets what concerns the whole file, in its first folder: versions, software, description, XMP, exposure, noise.
void set_file_tags(const DngImage& image, TiffFolderBytes& folder, std::vector<std::string>& notes);

/// Sets what concerns the RAW image, in its folder, but for where its blocks lie.
void set_raw_tags(const DngImage& image, const DngOptions& options, const ImageBlocks& blocks, TiffFolderBytes& folder);
/// Sets where they lie: one after the other from `offset`.
void set_raw_offsets(const ImageBlocks& blocks, std::uint32_t offset, TiffFolderBytes& folder);

/// Sets what concerns the preview, which lies at `offset`.
void set_preview_tags(const DngImage& image, std::uint32_t offset, TiffFolderBytes& folder);
/// Of the preview.
std::size_t preview_bytes(const DngImage& image);

} // namespace srisp
