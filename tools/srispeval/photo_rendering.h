// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "raw_picture.h"

namespace srisp::tool {

/// Where the photo of a RAW file comes from.
struct RenderingKind {
    const char* name;
    const char* program; ///< that must be installed; null: none
    const char* text;    ///< one sentence, for the report and the help
};

/// All that can be asked for: the three of our own first.
const std::vector<RenderingKind>& rendering_kinds();
const RenderingKind& rendering_kind(const std::string& name);

/// Whether it needs the RAW image alone, no file.
bool is_our_own(const RenderingKind& kind);

/// The photo of a RAW file, display-encoded sRGB of the picture's size. `name` is what chance depends on beside the
/// seed. Errors, without the file's name: a program that fails, no embedded picture, a photo of another shape.
Expected<Pixels> photo_of_raw(const RenderingKind& kind, const std::string& path, const RawPicture& raw,
                              const std::string& name, std::uint64_t seed);

} // namespace srisp::tool
