// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "evaluation.h"
#include "evenly_spread.h"
#include "packed_images.h"
#include "random.h"
#include "test_scenes.h"

namespace srisp::train {

namespace {

constexpr std::uint64_t kExposureStream = 0x7265616c; // apart from all other draws of the evaluation

/// The exposure that puts the 98th percentile of the pixels' largest channel at `level`; 1 is where a sensor clips.
torch::Tensor exposed(const torch::Tensor& raw, double level)
{
    const double bright = torch::quantile(std::get<0>(raw.max(0)).flatten(), 0.98).item<double>();
    return (raw * (level / std::max(bright, 1e-4))).clamp(0, 1);
}

/// The true gains, or grey world where the pack does not know them.
torch::Tensor white_balance(const PackEntry& entry, const torch::Tensor& raw)
{
    if (entry.white_balance[1] > 0)
        return torch::tensor(at::ArrayRef<float>(entry.white_balance));
    const auto means = raw.mean(at::IntArrayRef{ 1, 2 }).clamp_min(1e-4);
    return means[1] / means;
}

} // namespace

TestScenes real_test_scenes(const EvaluationSettings& settings, const PackedImages& raws)
{
    TestScenes scenes;
    scenes.set = "real";
    std::vector<torch::Tensor> images, white_balances, colors;
    std::map<std::string, std::vector<std::size_t>> by_camera;
    for (const std::size_t i : whole_images(raws, settings.real_validation_only))
        by_camera[raws.entries[i].group].push_back(i);
    for (const auto& [camera, all] : by_camera) {
        for (const std::size_t which : evenly_spread(all.size(), settings.real_images)) {
            const std::size_t i = all[which];
            if (scenes.cameras.empty() || scenes.cameras.back() != camera)
                scenes.cameras.push_back(camera);
            scenes.camera.push_back(static_cast<int>(scenes.cameras.size()) - 1);
            Random random(settings.seed, kExposureStream, i);
            const double level =
                std::exp(random.uniform(std::log(settings.exposure_low), std::log(settings.exposure_high)));
            images.push_back(exposed(packed_image(raws, i), level));
            white_balances.push_back(white_balance(raws.entries[i], images.back()));
            colors.push_back(torch::tensor(at::ArrayRef<float>(raws.entries[i].color)).view({ 3, 3 }));
        }
    }
    if (!images.empty()) {
        scenes.raw = torch::stack(images);
        scenes.white_balance = torch::stack(white_balances);
        scenes.color = torch::stack(colors);
    }
    return scenes;
}

} // namespace srisp::train
