// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/matrix3.h"
#include "train/evaluation/scores.h"
#include "train/evaluation/test_scenes.h"
#include "train/network/unprocessor.h"

namespace srisp::train {

/// Photos of other people and references, which have nothing to do with each other; every photo gets every reference.
struct UnpairedImages {
    torch::Tensor photos, references;   ///< [P, 3, S, S] and [R, 3, S, S]
    std::vector<Matrix3> camera_to_xyz; ///< of each reference
    UnpairedScores::Method gain_match;
};

/// Validation photos of the pack, and references spread evenly over the scenes of all sets. A camera whose matrix is
/// not known takes the mean of `matrices` [K, 3, 3]. Nothing where the settings or the pack have no photos.
std::optional<UnpairedImages> make_unpaired_images(const EvaluationSettings& settings, const PackedImages& photos,
                                                   const std::vector<TestScenes>& sets, const torch::Tensor& matrices,
                                                   Unprocessor& gain_match);

UnpairedScores evaluate_unpaired(Unprocessor& method, const UnpairedImages& images, int thumbnail_px);

} // namespace srisp::train
