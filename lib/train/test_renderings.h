// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "test_scenes.h"

namespace srisp::train {

/// How the photos of test scenes are made. How they are made decides the score, so these never change with what a
/// training is given, and scores of the two are kept apart. [method 5]

/// White-balanced camera RGB → linear sRGB, [K, 3, 3], of the pack's cameras that are meant for training, each in a
/// light drawn with `seed`; of the DND cameras where the pack has none.
torch::Tensor test_matrices(const TrainingPack& pack, int seed);

/// ISP_rand: white balance, exposure, gamma and tone curve of each image are random, the matrix is a mix of `matrices`.
torch::Tensor random_rendering(const TestScenes& scenes, const torch::Tensor& matrices, int seed);

/// Fixed exposure target, true white balance, the camera's own matrix, sRGB's curve. A camera whose matrix is not known
/// takes the mean of `matrices`.
torch::Tensor fixed_rendering(const TestScenes& scenes, const torch::Tensor& matrices);

/// The camera's own matrices, and the mean of `matrices` where they are not known, [N, 3, 3].
torch::Tensor known_colors(const torch::Tensor& colors, const torch::Tensor& matrices);

} // namespace srisp::train
