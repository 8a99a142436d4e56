// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pack/training_pack_index.h"
#include <srisp/expected.h>

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

} // namespace srisp::tool
