// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "rendering/test_rendering.h"
#include "train/evaluation/measure.h"
#include "train/samples/packed_images.h"
#include "train/samples/simulated_camera.h"
#include "train/samples/simulation.h"
#include "train/tensors/color.h"
#include "train/tensors/random.h"
#include "train/tensors/resize.h"

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

// Apart from all other draws of the evaluation.
constexpr std::uint64_t kCaptureStream = 0x63617074757265, kSceneStream = 0x7363656e65;

/// Method.md section 6, second series, written out so that other defaults change no score. Photos are uneven enough as
/// they are: gain match's error of ln mean deviates by 0.77 here, by 0.57 on real RAW.
SimulationSettings test_simulation(const EvaluationSettings& settings, TestExposure exposure)
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
    if (exposure == TestExposure::camera) {
        simulation.exposure_of = "percentile";
        simulation.lowest_exposure = settings.camera_exposure_low;
        simulation.highest_exposure = settings.camera_exposure_high;
    }
    simulation.lowest_flare = simulation.highest_flare = 0;
    simulation.lowest_black_error = simulation.highest_black_error = 0;
    return simulation;
}

// Apart from all other draws of the evaluation.
constexpr std::uint64_t kLightStream = 0x6c69676874, kRenderingStream = 0x72656e646572, kCameraGainStream = 0x6761696e;

template<class Array> Array values(const torch::Tensor& tensor)
{
    const auto contiguous = tensor.to(torch::kFloat32).contiguous();
    Array result;
    std::copy_n(contiguous.data_ptr<float>(), result.size(), result.begin());
    return result;
}

std::vector<Matrix3> matrix_list(const torch::Tensor& matrices)
{
    std::vector<Matrix3> result;
    for (std::int64_t k = 0; k < matrices.size(0); ++k)
        result.push_back(values<Matrix3>(matrices[k]));
    return result;
}

/// A photo of each scene; `make` gets the number of the scene and what is known of it.
template<class Make> torch::Tensor rendered(const TestScenes& scenes, const torch::Tensor& matrices, const Make& make)
{
    const InterleavedImages raws(scenes.raw);
    const auto colors = known_colors(scenes.color, matrices);
    std::vector<torch::Tensor> photos;
    for (std::int64_t n = 0; n < scenes.raw.size(0); ++n) {
        const ImageView raw = raws[n];
        const auto photo = torch::empty({ raw.height, raw.width, 3 });
        render(make(n, RawScene{ raw, values<Vector3>(scenes.white_balance[n]), values<Matrix3>(colors[n]) }), raw,
               { photo.data_ptr<float>(), raw.width, raw.height, 3, std::ptrdiff_t(3) * raw.width });
        photos.push_back(photo.permute({ 2, 0, 1 }));
    }
    return torch::stack(photos);
}

} // namespace

torch::Tensor left_halves(const torch::Tensor& images)
{
    return images.slice(3, 0, images.size(3) / 2).contiguous();
}

torch::Tensor right_quarters(const torch::Tensor& images)
{
    const auto height = images.size(2), width = images.size(3);
    const auto right = images.slice(3, width - width / 2, width);
    const auto top = right.slice(2, 0, height / 2), bottom = right.slice(2, height - height / 2, height);
    return torch::stack({ top, bottom }, 1).flatten(0, 1).contiguous();
}

TestScenes real_test_scenes(const EvaluationSettings& settings, const PackedImages& raws, TestExposure exposure)
{
    TestScenes scenes;
    scenes.set = "real";
    const bool wide = exposure == TestExposure::wide;
    const double low = wide ? settings.exposure_low : settings.camera_exposure_low;
    const double high = wide ? settings.exposure_high : settings.camera_exposure_high;
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
            images.push_back(exposed(packed_image(raws, i), random.log_uniform(low, high)));
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

TestScenes simulated_test_scenes(const EvaluationSettings& settings, const TrainingPack& pack, TestExposure exposure)
{
    TestScenes scenes;
    scenes.set = "simulated";
    const std::vector<bool>& held_out = pack.cameras().validation;
    const std::vector<std::size_t> photos = whole_images(pack.photos(), true);
    if (photos.empty() || std::find(held_out.begin(), held_out.end(), true) == held_out.end() ||
        settings.simulated_images == 0)
        return scenes;
    const SimulatedCameras cameras(pack.cameras());
    const SimulationSettings simulation = test_simulation(settings, exposure);
    std::vector<torch::Tensor> images;
    std::vector<Capture> captures;
    Randoms randoms;
    for (int i = 0; i < settings.simulated_images; ++i) {
        images.push_back(
            packed_image(pack.photos(), photos[std::size_t(i) * photos.size() / settings.simulated_images]));
        captures.push_back(draw_capture(simulation, cameras, true, Random(settings.seed, kCaptureStream, i)));
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
    scenes.raw = simulate(simulation, area_resize(torch::stack(images), size, size), captures, randoms);
    scenes.white_balance = white_balances(captures);
    scenes.color = color_matrices(captures);
    return scenes;
}

torch::Tensor test_matrices(const TrainingPack& pack, int seed)
{
    const SimulatedCameras cameras(pack.cameras());
    std::vector<torch::Tensor> matrices;
    for (int camera = 0; camera < cameras.count(); ++camera) {
        if (cameras.validation()[camera])
            continue;
        Random random(seed, kLightStream, camera);
        const CameraColor color = camera_color(cameras.to_camera(camera, cameras.draw_light(LightSettings(), random)));
        matrices.push_back(torch::tensor(at::ArrayRef<float>(color.color)).view({ 3, 3 }));
    }
    return matrices.empty() ? torch::inverse(dnd_rgb_to_camera()) : torch::stack(matrices);
}

torch::Tensor random_rendering(const TestScenes& scenes, const torch::Tensor& matrices, int seed)
{
    const std::vector<Matrix3> others = matrix_list(matrices);
    return rendered(scenes, matrices, [&](std::int64_t n, const RawScene& scene) {
        return srisp::random_rendering(scene, others, Random(seed, kRenderingStream, n));
    });
}

torch::Tensor fixed_rendering(const TestScenes& scenes, const torch::Tensor& matrices)
{
    return rendered(scenes, matrices,
                    [](std::int64_t, const RawScene& scene) { return srisp::fixed_rendering(scene); });
}

torch::Tensor camera_rendering(const TestScenes& scenes, const torch::Tensor& matrices, int seed)
{
    const std::vector<Matrix3> others = matrix_list(matrices);
    return rendered(scenes, matrices, [&](std::int64_t n, const RawScene& scene) {
        const double gain = draw_camera_gain(Random(seed, kCameraGainStream, scenes.camera[n]));
        return srisp::camera_rendering(scene, others, gain, Random(seed, kRenderingStream, n));
    });
}

torch::Tensor known_colors(const torch::Tensor& colors, const torch::Tensor& matrices)
{
    const auto known = colors.abs().sum({ 1, 2 }, true) > 0;
    return torch::where(known, colors, matrices.mean(0, true));
}

} // namespace srisp::train
