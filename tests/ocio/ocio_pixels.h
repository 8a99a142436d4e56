// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>
#include <doctest/doctest.h>
#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/neutral_rendition.h>
#include <srisp/reference.h>
#include <srisp/select.h>

#include "../random_model.h" // ScratchFolder, Random

namespace OCIO = OCIO_NAMESPACE;

template<class T> T require(srisp::Expected<T> result)
{
    REQUIRE_MESSAGE(result, (result ? "" : result.error().message));
    return std::move(*result);
}

inline void require(const srisp::Status& status)
{
    REQUIRE_MESSAGE(status, status.error().message);
}

/// Interleaved colours; a row as an image.
using Colors = std::vector<float>;

/// n³ colours over [0,1]³; n − 1 shares no factor with the sizes of LUTs, so most lie between their points.
inline Colors dense_grid(int n)
{
    Colors rgb;
    for (int r = 0; r < n; ++r)
        for (int g = 0; g < n; ++g)
            for (int b = 0; b < n; ++b)
                for (const int i : { r, g, b })
                    rgb.push_back(float(i) / float(n - 1));
    return rgb;
}

/// Greys and nearly grey colours from 0.85 to 1, where the highlight-preserving gains bend.
inline Colors near_white(int count)
{
    Colors rgb;
    Random random(5);
    for (int i = 0; i < count; ++i) {
        const float grey = random.uniform(0.85f, 1.0f), spread = i % 2 ? 0.0f : 0.1f;
        for (int c = 0; c < 3; ++c)
            rgb.push_back(std::min(grey + random.uniform(-spread, spread), 1.0f));
    }
    return rgb;
}

inline Colors through_ocio(const OCIO::ConstTransformRcPtr& transform, Colors rgb)
{
    const auto processor = OCIO::Config::CreateRaw()->getProcessor(transform)->getDefaultCPUProcessor();
    OCIO::PackedImageDesc image(rgb.data(), long(rgb.size() / 3), 1, 3);
    processor->apply(image);
    return rgb;
}

inline Colors through_library(const srisp::Model& model, const srisp::Parameters& parameters,
                              srisp::Direction direction, Colors rgb)
{
    const int width = int(rgb.size() / 3);
    const srisp::MutableImageView view{ rgb.data(), width, 1, 3, 3 * width };
    require(require(srisp::Applier::create(model, parameters, direction))->run(view, view));
    return rgb;
}

inline std::shared_ptr<const srisp::Model> default_model()
{
    return require(srisp::Model::load(std::string(SRISP_SOURCE_DIR) + "/configs/models/default.safetensors"));
}

/// What the model chooses for the sample reference and its own neutral rendition.
inline srisp::Parameters sample_parameters(const srisp::Model& model)
{
    const auto reference =
        require(srisp::load_reference(std::string(SRISP_SOURCE_DIR) + "/configs/sample/reference.dng"));
    return require(srisp::select(model, srisp::neutral_rendition(*reference), reference->thumbnail));
}
