// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include <srisp/image.h>
#include <srisp/parameters.h>

#include "model/model_data.h"
#include "select/planar_thumbnail.h"
#include "select/reference_features.h"

namespace srisp {

/// What happens inside `select`, step by step; tests compare it with the golden values.
struct SelectionTrace {
    std::array<float, 12> source_statistics{}, reference_statistics{};
    std::vector<float> source_features, reference_features, fused_features;
    std::array<float, 3> base_gain{ 1, 1, 1 };
    PlanarThumbnail after_tone, after_gamma, after_color, after_white_balance, after_gain;
};

/// `select` without its checks. Fills `notes` and `trace` where they are given.
Parameters select_parameters(const ModelData& model, const Thumbnail& source, const ReferenceFeatures& reference,
                             std::vector<std::string>* notes, SelectionTrace* trace);

} // namespace srisp
