// SPDX-License-Identifier: Apache-2.0
#include "select/reference_features.h"

namespace srisp {

ImageFeatures image_features(const ModelData& model, const EncoderWeights& encoder,
                             const std::optional<DenseLayer>& statistics_layer, EncoderInput input,
                             const LinearImage& linear)
{
    ImageFeatures features;
    if (!model.anchor_network.empty())
        features.colors = color_features(linear.whole, linear.small);
    else if (statistics_layer)
        features.colors.statistics =
            statistics(linear.whole.planes, linear.whole.height * std::size_t(linear.whole.width));
    features.encoded = encode(encoder, std::move(input));
    if (statistics_layer) {
        const auto& numbers = features.colors.statistics;
        add(features.encoded, transformed(*statistics_layer, { numbers.begin(), numbers.end() }));
    }
    return features;
}

ReferenceFeatures reference_features(const ModelData& model, const Thumbnail& reference)
{
    const PlanarThumbnail image(reference, model.selection_size);
    const LinearImage linear(image);
    ReferenceFeatures features;
    static_cast<ImageFeatures&>(features) = image_features(model, model.reference_encoder, model.reference_statistics,
                                                           linear_input(image, model.perceptual_encoder_input), linear);
    features.model_hash = model.hash;
    if (!model.anchor_network.empty())
        features.match.emplace(linear.small);
    return features;
}

} // namespace srisp
