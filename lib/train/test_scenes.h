// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pack/training_pack.h"
#include "torch_api.h"

namespace srisp::train {

struct EvaluationSettings;

/// Linear RAW images to be tested on, N of them.
struct TestScenes {
    std::string set; ///< "real", "simulated"
    std::vector<std::string> cameras;
    std::vector<int> camera;     ///< of each image
    torch::Tensor raw;           ///< [N, 3, S, S], camera RGB in [0, 1], as exposed
    torch::Tensor white_balance; ///< [N, 3], (g_r, 1, g_b), true
    torch::Tensor color; ///< [N, 3, 3], white-balanced camera RGB → linear sRGB, the camera's own; 0 where not known
};

/// The pack's real RAW images, equally many of each camera, spread evenly over its images. Stored
/// images may have lost their exposure (each divided by its own maximum), so each gets a random one.
TestScenes real_test_scenes(const EvaluationSettings& settings, const PackedImages& raws);

/// Photos, cameras and lights that are marked for validation, simulated.
TestScenes simulated_test_scenes(const EvaluationSettings& settings, const TrainingPack& pack);

} // namespace srisp::train
