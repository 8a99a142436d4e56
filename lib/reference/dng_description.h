// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "base/file_bytes.h"
#include "reference/raw_pixels.h"

namespace srisp {

/// The image data of a DNG whose strips or tiles are lossy JPEGs of 8 bits, and how they become linear.
struct LossyDngData {
    struct Block {
        std::size_t offset, size; ///< in the file, and within it
    };
    int block_width = 0, block_height = 0;
    std::vector<Block> blocks;                ///< row by row; as many as cover the stored image
    std::vector<std::uint16_t> linearization; ///< LinearizationTable; may be empty
    std::string opcodes;                      ///< bytes of OpcodeList2; may be empty
};

/// What a DNG's own tags say of its main image: geometry, levels, colours, camera. LibRaw 0.20 rounds black levels to
/// integers, averages BlackLevelDeltaH/V and crops odd active areas, so we follow the tags and leave it the
/// decompression.
struct DngDescription {
    int stored_width = 0, stored_height = 0; ///< with masked pixels
    int left = 0, top = 0;                   ///< of the active area
    int samples = 1, bits = 16;
    bool is_float = false;
    int compression = 1;               ///< TIFF code: 1 none, 7 JPEG (mostly lossless), 8 Deflate, 34892 lossy JPEG
    std::uint32_t folder_offset = 0;   ///< of the main image's tags in the file
    std::optional<LossyDngData> lossy; ///< where the image data are lossy JPEGs of 8 bits
    RawPixels layout;                  ///< width, height, channels, cfa, black, white; no samples yet
    CameraFacts facts;
    std::vector<std::string> notes;
};

/// Reads the description if the file is a DNG (nothing if it is not). Errors, without the file's name: no main image,
/// sizes of 0 or beyond 65535, an active area outside the image, filters that are not R, G, B, monochrome, levels that
/// can't be, image data beyond the end of the file (truncated), layouts and compressions that nothing here decodes.
Expected<std::optional<DngDescription>> describe_dng(const FileBytes& file);

} // namespace srisp
