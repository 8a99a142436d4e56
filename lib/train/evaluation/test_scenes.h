// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "pack/training_pack.h"
#include "train/tensors/torch_api.h"

namespace srisp::train {

/// `count` of the indices 0 … total − 1, or all of them, evenly spread.
inline std::vector<std::size_t> evenly_spread(std::size_t total, std::size_t count)
{
    count = std::min(count, total);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back((2 * i + 1) * total / (2 * count));
    return chosen;
}

/// The half split of N images [N, 3, H, W]: what is right of the middle, top and bottom, is unprocessed with what is
/// left of it as reference. Crops 2n and 2n + 1 belong to image n. A middle row or column of odd sizes is left out.
/// [P 4.3]
torch::Tensor left_halves(const torch::Tensor& images);    ///< [N, 3, H, W / 2]
torch::Tensor right_quarters(const torch::Tensor& images); ///< [2N, 3, H / 2, W / 2]

/// What is tested, and how much of it.
struct EvaluationSettings {
    int real_images = 24;
    bool real_validation_only = true;
    double exposure_low = 0.03, exposure_high = 1.25;
    double camera_exposure_low = 0.15, camera_exposure_high = 1.25;
    std::string developed;
    int simulated_images = 96;
    int unpaired_photos = 0;
    int unpaired_references = 8;
    int thumbnail_px = 0;
    int seed = 1;

    template<class Visitor> void describe(Visitor& v)
    {
        v.integer("real_images", real_images, 0, 100000, "real RAW images of each camera in the pack");
        v.flag("real_validation_only", real_validation_only, "real RAW: leave out what is meant for training");
        v.range("exposure", exposure_low, exposure_high, 1e-3, 100,
                "real RAW: where exposure puts the 98th percentile of an image, log-uniform (1: clipping begins)");
        v.range("camera_exposure", camera_exposure_low, camera_exposure_high, 1e-3, 100,
                "the same for the rendering of cameras, which do not make up for an exposure");
        v.path("developed", developed,
               "file of real RAW images and what RAW converters made of them, by tests/bench/develop_raws.py");
        v.integer("simulated_images", simulated_images, 0, 100000,
                  "simulated RAW images: validation photos, cameras and lights");
        v.integer("unpaired_photos", unpaired_photos, 0, 100000, "photos for the test without truth; 0: none");
        v.integer("unpaired_references", unpaired_references, 2, 1000, "references that each of these photos gets");
        v.integer("thumbnail_px", thumbnail_px, 0, 1024,
                  "side of the squares on which parameters are chosen; 0: the crops as they are");
        v.integer("seed", seed, 0, 1000000000, "of exposures, renderings and simulated cameras");
    }
};

/// Linear RAW images to be tested on, N of them.
struct TestScenes {
    std::string set; ///< "real", "simulated", "developed"
    std::vector<std::string> cameras;
    std::vector<int> camera;     ///< of each image
    torch::Tensor raw;           ///< [N, 3, S, S], camera RGB in [0, 1], as exposed
    torch::Tensor white_balance; ///< [N, 3], (g_r, 1, g_b), true
    torch::Tensor color; ///< [N, 3, 3], white-balanced camera RGB → linear sRGB, the camera's own; 0 where not known
};

/// How test scenes are exposed: for renderings that make up for it, over a wide range; for those of cameras, as one
/// does who looks at the pictures.
enum class TestExposure { wide, camera };

/// The pack's real RAW images, equally many of each camera, spread evenly over its images. Stored
/// images may have lost their exposure (each divided by its own maximum), so each gets a random one.
TestScenes real_test_scenes(const EvaluationSettings& settings, const PackedImages& raws, TestExposure exposure);

/// Photos, cameras and lights that are marked for validation, simulated.
TestScenes simulated_test_scenes(const EvaluationSettings& settings, const TrainingPack& pack, TestExposure exposure);

// How the photos of test scenes are made decides the score, so these never change with what a training is given, and
// scores of the two are kept apart. [method 5]

/// White-balanced camera RGB → linear sRGB, [K, 3, 3], of the pack's cameras that are meant for training, each in a
/// light drawn with `seed`; of the DND cameras where the pack has none.
torch::Tensor test_matrices(const TrainingPack& pack, int seed);

/// ISP_rand: white balance, exposure, gamma and tone curve of each image are random, the matrix is a mix of `matrices`.
torch::Tensor random_rendering(const TestScenes& scenes, const torch::Tensor& matrices, int seed);

/// Fixed exposure target, true white balance, the camera's own matrix, sRGB's curve. A camera whose matrix is not known
/// takes the mean of `matrices`.
torch::Tensor fixed_rendering(const TestScenes& scenes, const torch::Tensor& matrices);

/// As cameras and RAW converters do: one gain for each camera, one curve for each image whatever it shows, mostly true
/// white balance and the camera's own matrix.
torch::Tensor camera_rendering(const TestScenes& scenes, const torch::Tensor& matrices, int seed);

/// The camera's own matrices, and the mean of `matrices` where they are not known, [N, 3, 3].
torch::Tensor known_colors(const torch::Tensor& colors, const torch::Tensor& matrices);

} // namespace srisp::train
