// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <srisp/develop.h>
#include <srisp/image.h>
#include <srisp/model.h>
#include <srisp/parameters.h>
#include <srisp/reference.h>

#include "bake_options.h"

namespace srisp::tool {

/// Parts of a photo, to compare renderings on, and its thumbnail; all from reading it once.
struct PhotoSample {
    struct Tile {
        Roi roi;                ///< the part
        std::vector<float> rgb; ///< interleaved, display-encoded
    };

    std::string name; ///< for messages
    int width = 0, height = 0;
    std::vector<Tile> tiles;
    Thumbnail thumbnail;
    std::vector<std::string> notes; ///< what was assumed or changed
};

/// 4 × 4 parts of at most 96 × 96 pixels, evenly spread; the whole of small photos. Throws Failure.
PhotoSample read_photo_sample(const std::string& path, bool allow_partial = false);

/// The same of a picture that is in memory, a thumbnail.
PhotoSample sample_of_thumbnail(const Thumbnail& picture, const std::string& name);

/// Everything that is baked, and what it is measured on.
struct BakeChoice {
    std::shared_ptr<const Model> model;
    Parameters parameters;                      ///< that the model chose, or was given
    std::shared_ptr<const Reference> reference; ///< null where only parameters are given
    std::optional<PhotoSample> photo;           ///< likewise, unless --source is there
    Development development;
    std::vector<std::string> notes; ///< about the reference and what was chosen
};

/// Loads and chooses what the options ask for. Throws Failure.
BakeChoice make_choice(const BakeOptions& options);

} // namespace srisp::tool
