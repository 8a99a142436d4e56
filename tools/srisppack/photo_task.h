// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "manifest.h"
#include "pack_task.h"

namespace srisp::tool {

/// Reads a photo (upright, sRGB) and squashes it and its crops. `name`: as the pack calls it. Fails for photos of fewer
/// than kSmallestPackImage pixels a side.
PackTask photo_task(const std::string& path, const std::string& name, const Provenance& provenance,
                    const CropSettings& settings);

} // namespace srisp::tool
