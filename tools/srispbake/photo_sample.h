// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/image.h>

namespace srisp::tool {

/// Parts of a photo, to compare renderings on, and its thumbnail; all from reading it once.
struct PhotoSample {
    /// Around each part, so that a spatial reverse and forward pass over it are exact.
    static constexpr int kHalo = 8;
    struct Tile {
        Roi roi;                ///< the part
        Roi held;               ///< the part and the halo, as far as the photo goes
        std::vector<float> rgb; ///< of `held`, interleaved, display-encoded
    };

    std::string name; ///< for messages
    int width = 0, height = 0;
    std::vector<Tile> tiles;
    Thumbnail thumbnail;
};

/// 4 × 4 parts of at most 96 × 96 pixels, evenly spread; the whole of small photos. Throws Failure.
PhotoSample read_photo_sample(const std::string& path);

/// The same of a picture that is in memory, a thumbnail.
PhotoSample sample_of_thumbnail(const Thumbnail& picture, const std::string& name);

} // namespace srisp::tool
