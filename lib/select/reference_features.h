// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <srisp/image.h>

#include "features/match_features.h"
#include "select/planar_thumbnail.h"

namespace srisp {

/// What a model sees of one image for itself: the same of photo and reference.
struct ImageFeatures {
    std::vector<float> encoded; ///< by its encoder, its statistics added
    ColorFeatures colors{};     ///< zeros where the model takes none
};

/// What selection needs of a reference alone.
struct ReferenceFeatures : ImageFeatures {
    std::string model_hash;              ///< of the model that they are for
    std::optional<MatchReference> match; ///< none: the model has no network for its anchor
};

/// An image in linear light, and its reduction for the features of colours.
struct LinearImage {
    explicit LinearImage(const PlanarThumbnail& thumbnail)
        : whole{ thumbnail.planes(), thumbnail.size(), thumbnail.size() }, small(reduced(whole))
    {
    }
    PlanarImage whole; ///< the thumbnail's own planes
    ReducedImage small;
};

/// Of an image as its encoder sees it, and in linear light.
ImageFeatures image_features(const ModelData& model, const EncoderWeights& encoder,
                             const std::optional<DenseLayer>& statistics_layer, EncoderInput input,
                             const LinearImage& linear);

/// `prepare_reference` without its checks.
ReferenceFeatures reference_features(const ModelData& model, const Thumbnail& reference);

} // namespace srisp
