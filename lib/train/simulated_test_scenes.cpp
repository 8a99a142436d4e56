// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "area_resize.h"
#include "evaluation.h"
#include "packed_images.h"
#include "simulation.h"
#include "test_scenes.h"

namespace srisp::train {

namespace {

// Apart from all other draws of the evaluation.
constexpr std::uint64_t kCaptureStream = 0x63617074757265, kSceneStream = 0x7363656e65;

/// Method.md section 6, second series, written out so that other defaults change no score. Photos are uneven enough as
/// they are: gain match's error of ln mean deviates by 0.77 here, by 0.57 on real RAW.
SimulationSettings test_simulation()
{
    SimulationSettings simulation;
    simulation.photo = PhotoInverseSettings();
    simulation.photo.lowest_gamma = 1.7;
    simulation.photo.highest_gamma = 3.4;
    simulation.photo.s_curve = simulation.photo.expansion = simulation.photo.histogram = 0;
    simulation.photo.lowest_saturation = 0.7;
    simulation.photo.highest_saturation = 1.5;
    simulation.light.daylight = 0.40;
    simulation.light.artificial = 0.15;
    simulation.lowest_unevenness = 0;
    simulation.highest_unevenness = 0;
    simulation.mixed_light = 0;
    simulation.exposure_of = "white";
    simulation.lowest_exposure = 0.06;
    simulation.highest_exposure = 2.5;
    simulation.lowest_flare = simulation.highest_flare = 0;
    simulation.lowest_black_error = simulation.highest_black_error = 0;
    return simulation;
}

} // namespace

TestScenes simulated_test_scenes(const EvaluationSettings& settings, const TrainingPack& pack)
{
    TestScenes scenes;
    scenes.set = "simulated";
    const std::vector<bool>& held_out = pack.cameras().validation;
    const std::vector<std::size_t> photos = whole_images(pack.photos(), true);
    if (photos.empty() || std::find(held_out.begin(), held_out.end(), true) == held_out.end() ||
        settings.simulated_images == 0)
        return scenes;
    const SimulatedCameras cameras(pack.cameras());
    std::vector<torch::Tensor> images;
    std::vector<Capture> captures;
    Randoms randoms;
    for (int i = 0; i < settings.simulated_images; ++i) {
        images.push_back(
            packed_image(pack.photos(), photos[std::size_t(i) * photos.size() / settings.simulated_images]));
        captures.push_back(draw_capture(test_simulation(), cameras, true, Random(settings.seed, kCaptureStream, i)));
        randoms.emplace_back(settings.seed, kSceneStream, i);
        const std::string& name = pack.cameras().names[captures.back().camera];
        const auto known = std::find(scenes.cameras.begin(), scenes.cameras.end(), name);
        scenes.camera.push_back(static_cast<int>(known - scenes.cameras.begin()));
        if (known == scenes.cameras.end())
            scenes.cameras.push_back(name);
    }
    // Crops as large as those of the real RAW images, where there are some.
    const int raw_size = pack.raws().entries.empty() ? pack.photos().size : pack.raws().size;
    const int size = std::min(pack.photos().size, raw_size);
    scenes.raw = simulate(test_simulation(), area_resize(torch::stack(images), size, size), captures, randoms);
    scenes.white_balance = white_balances(captures);
    scenes.color = color_matrices(captures);
    return scenes;
}

} // namespace srisp::train
