// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "manifest.h"
#include "pack/training_pack_index.h"

namespace srisp::tool {

/// One photo or RAW image as it goes into a pack.
struct PackedScene {
    PackScene scene;
    std::vector<std::uint16_t> pixels; ///< [crops, 3, size, size]
    bool enlarged = false;             ///< it has fewer pixels than the pack asks for
    std::string left_out;              ///< why it does not go into the pack; "" if it does
};

/// What makes one; run on any thread.
struct PackTask {
    std::string name; ///< for messages
    std::function<Expected<PackedScene>()> run;
};

/// What all images of a part have in common.
struct CropSettings {
    int size = 128; ///< of the squashed images, pixels
    int crops = 3;  ///< beside the whole
    std::uint64_t seed = 0;
};

/// Reads a photo (upright, sRGB) and squashes it and its crops. `name`: as the pack calls it. Fails for photos of fewer
/// than kSmallestPackImage pixels a side.
PackTask photo_task(const std::string& path, const std::string& name, const Provenance& provenance,
                    const CropSettings& settings);

/// Reads a RAW file (or a linear image) as srisptool reads references, and squashes it and its crops; white balance and
/// colour matrix as the file states them. Crops come from the thumbnail of 256 × 256, so `settings.size` is at most
/// that.
PackTask raw_task(const std::string& path, const std::string& name, const Provenance& provenance,
                  const CropSettings& settings);

} // namespace srisp::tool
