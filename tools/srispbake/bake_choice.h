// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <srisp/image.h>
#include <srisp/model.h>
#include <srisp/parameters.h>
#include <srisp/reference.h>

#include "bake_options.h"

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
    std::vector<std::string> notes; ///< what was assumed or changed
};

/// 4 × 4 parts of at most 96 × 96 pixels, evenly spread; the whole of small photos. Throws Failure.
PhotoSample read_photo_sample(const std::string& path, bool allow_partial = false);

/// The same of a picture that is in memory, a thumbnail.
PhotoSample sample_of_thumbnail(const Thumbnail& picture, const std::string& name);

/// A model and the parameters that it chose or was given.
struct Chosen {
    std::shared_ptr<const Model> model;
    Parameters parameters;
};

/// Everything that is baked, and what it is compared with.
struct BakeChoice {
    Chosen pointwise;
    std::shared_ptr<const Reference> reference; ///< null where only parameters are given
    std::optional<PhotoSample> photo;           ///< likewise, unless --source is there
    bool photo_is_rendition = false;            ///< the reference's own neutral rendition stands in
    std::optional<Chosen> full;                 ///< `default` with the same photo and reference
    std::vector<std::string> notes;             ///< about the reference and what was chosen
};

/// Loads and chooses what the options ask for. Throws Failure.
BakeChoice make_choice(const BakeOptions& options);

} // namespace srisp::tool
