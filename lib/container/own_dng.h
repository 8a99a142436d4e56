// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include <srisp/camera.h>
#include <srisp/expected.h>

namespace srisp {

/// What a DNG says of itself that holds the record of an unprocessed photo.
struct OwnDng {
    std::string description; ///< LibRaw cuts it off
    CameraFacts facts;       ///< its as-shot neutral is that of the scene
    /// White above black, in the file's units: of R, G in the rows of R, B, G in the rows of B.
    std::array<float, 4> ranges{};
    bool is_float = false;          ///< three channels, 0 is black, 1 white
    std::uint32_t image_folder = 0; ///< where the tags of the image lie
    std::string truncation;         ///< what is missing of the image data; empty: nothing
};

/// Null: the file is none. `named_raw`: its name is that of a RAW file; a TIFF of another name, which may be huge, is
/// looked into only where it begins as DNGs do. Errors, without the file's name: filters or levels that are damaged,
/// too few pixels for LibRaw, those of read_whole_file.
Expected<std::shared_ptr<const OwnDng>> find_own_dng(const std::string& path, bool named_raw);

} // namespace srisp
