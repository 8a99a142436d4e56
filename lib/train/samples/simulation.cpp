// SPDX-License-Identifier: Apache-2.0
#include "train/samples/simulation.h"

#include <cmath>

#include "train/tensors/color.h"
#include "train/tensors/random.h"

namespace srisp::train {

namespace {

/// Purposes of random numbers within a sample.
enum Purpose { kPhoto, kUnevenness, kUnevenField, kMixField, kNoise, kFlare };

int draw_camera(const SimulatedCameras& cameras, bool validation, Random& random)
{
    std::vector<int> candidates;
    for (int i = 0; i < cameras.count(); ++i)
        if (cameras.validation()[i] == validation)
            candidates.push_back(i);
    TORCH_CHECK(!candidates.empty(), "no simulated camera for ", validation ? "validation" : "training");
    return candidates[random.integer(candidates.size())];
}

/// A camera's colour in the mean of one or two lights; `difference` gets half of the second minus the first.
CameraColor light_mean(const SimulatedCameras& cameras, int camera,
                       const std::vector<SimulatedCameras::Spectrum>& lights, Matrix3* difference)
{
    const CameraColor first = camera_color(cameras.to_camera(camera, lights.front()));
    if (lights.size() == 1)
        return first;
    const CameraColor second = camera_color(cameras.to_camera(camera, lights.back()));
    Matrix3 mean;
    for (int i = 0; i < 9; ++i) {
        mean[i] = (first.to_camera[i] + second.to_camera[i]) / 2;
        if (difference)
            (*difference)[i] = (second.to_camera[i] - first.to_camera[i]) / 2;
    }
    return camera_color(mean);
}

/// One number of each capture, [N, 1, 1, 1].
template<class Get> torch::Tensor each(const std::vector<Capture>& captures, const torch::Device& device, Get get)
{
    auto values = torch::empty({ static_cast<std::int64_t>(captures.size()), 1, 1, 1 });
    float* value = values.data_ptr<float>();
    for (const Capture& capture : captures)
        *value++ = static_cast<float>(get(capture));
    return values.to(device);
}

/// One matrix of each capture, [N, 3, 3].
template<class Get> torch::Tensor matrices(const std::vector<Capture>& captures, Get get)
{
    auto values = torch::empty({ static_cast<std::int64_t>(captures.size()), 3, 3 });
    float* value = values.data_ptr<float>();
    for (const Capture& capture : captures)
        for (const float entry : get(capture))
            *value++ = entry;
    return values;
}

} // namespace

Capture draw_capture(const SimulationSettings& settings, const SimulatedCameras& cameras, bool validation,
                     Random random)
{
    Capture capture;
    capture.camera = draw_camera(cameras, validation, random);
    const bool mixed = random.chance(settings.mixed_light);
    capture.exposure = random.log_uniform(settings.lowest_exposure, settings.highest_exposure);
    capture.black_error = random.uniform(settings.lowest_black_error, settings.highest_black_error);
    const double averaged = random.log_uniform(settings.lowest_averaged, settings.highest_averaged);
    const double shot = random.log_uniform(settings.lowest_shot, settings.highest_shot);
    capture.shot = shot / averaged;
    capture.read = std::exp(2.18 * std::log(shot) + 1.20 + 0.26 * random.normal()) / averaged; // [method 4: UPI]
    for (int i = 0; i < (mixed ? 2 : 1); ++i) {
        Random light = random.fork(i);
        capture.lights.push_back(cameras.draw_light(settings.light, light));
    }
    capture.color = light_mean(cameras, capture.camera, capture.lights, &capture.difference);
    return capture;
}

torch::Tensor white_balances(const std::vector<Capture>& captures)
{
    auto values = torch::empty({ static_cast<std::int64_t>(captures.size()), 3 });
    float* value = values.data_ptr<float>();
    for (const Capture& capture : captures)
        for (const float gain : capture.color.white_balance)
            *value++ = gain;
    return values;
}

torch::Tensor color_matrices(const std::vector<Capture>& captures)
{
    return matrices(captures, [](const Capture& capture) { return capture.color.color; });
}

torch::Tensor other_color_matrices(const SimulatedCameras& cameras, const std::vector<Capture>& captures, int count,
                                   Randoms& randoms)
{
    auto values = torch::empty({ static_cast<std::int64_t>(captures.size()), count, 3, 3 });
    float* value = values.data_ptr<float>();
    for (std::size_t n = 0; n < captures.size(); ++n) {
        std::vector<int> others;
        for (int i = 0; i < cameras.count(); ++i)
            if (!cameras.validation()[i] && i != captures[n].camera)
                others.push_back(i);
        if (others.empty())
            others.push_back(captures[n].camera);
        for (int k = 0; k < count; ++k) {
            const std::size_t first = k % others.size();
            std::swap(others[first], others[first + randoms[n].integer(others.size() - first)]);
            const Matrix3 matrix = light_mean(cameras, others[first], captures[n].lights, nullptr).color;
            value = std::copy(matrix.begin(), matrix.end(), value);
        }
    }
    return values;
}

torch::Tensor camera_scenes(const SimulationSettings& settings, const torch::Tensor& photos,
                            const std::vector<Capture>& captures, const Randoms& randoms)
{
    const auto device = photos.device();
    const auto height = photos.size(2), width = photos.size(3);
    auto photo_randoms = fork(randoms, kPhoto);
    const auto linear = undo_rendering(settings.photo, photos, photo_randoms);
    auto scenes = transform_colors(matrices(captures, [](const Capture& c) { return c.color.to_camera; }), linear);
    if (settings.mixed_light > 0) {
        auto field_randoms = fork(randoms, kMixField);
        const auto share = torch::tanh(2 * smooth_fields(field_randoms, height, width, device));
        scenes = scenes +
                 share * transform_colors(matrices(captures, [](const Capture& c) { return c.difference; }), linear);
    }
    auto level_randoms = fork(randoms, kUnevenness), field_randoms = fork(randoms, kUnevenField);
    const auto deviation = per_image(level_randoms, device, [&](Random& random) {
        return random.uniform(settings.lowest_unevenness, settings.highest_unevenness);
    });
    scenes.mul_(smooth_fields(field_randoms, height, width, device).mul_(deviation).exp_());
    auto flare_randoms = fork(randoms, kFlare);
    const auto flare = per_image(flare_randoms, device, [&](Random& random) {
        return random.uniform(settings.lowest_flare, settings.highest_flare);
    });
    if (settings.highest_flare > 0)
        scenes = scenes * (1 - flare) + flare * scenes.mean({ 2, 3 }, true);
    // Colours outside the camera's gamut would be negative light.
    return scenes.clamp_min_(0);
}

torch::Tensor exposure_factors(const SimulationSettings& settings, const torch::Tensor& scenes,
                               const std::vector<Capture>& captures)
{
    auto factors = each(captures, scenes.device(), [](const Capture& capture) { return capture.exposure; });
    if (settings.exposure_of == "percentile")
        factors = factors / row_quantile(scenes.amax(1).flatten(1), 0.97).clamp_min(1e-4).view_as(factors);
    return factors;
}

torch::Tensor expose(const torch::Tensor& scenes, const torch::Tensor& factors, const std::vector<Capture>& captures,
                     const Randoms& randoms)
{
    const auto device = scenes.device();
    const auto shot = each(captures, device, [](const Capture& capture) { return capture.shot; });
    const auto read = each(captures, device, [](const Capture& capture) { return capture.read; });
    const auto black_error = each(captures, device, [](const Capture& capture) { return capture.black_error; });
    auto noise_randoms = fork(randoms, kNoise);
    const auto clean = scenes * factors;
    // Above the clipping point noise would not be seen, but its variance would overflow for endless light.
    const auto deviation = clean.clamp_max(2).mul_(shot).add_(read).sqrt_();
    const auto grain = noise(noise_randoms, scenes.sizes().slice(1)).to(device).mul_(deviation);
    return grain.add_(clean).add_(black_error).clamp_(0, 1);
}

torch::Tensor simulate(const SimulationSettings& settings, const torch::Tensor& photos,
                       const std::vector<Capture>& captures, const Randoms& randoms)
{
    const auto scenes = camera_scenes(settings, photos, captures, randoms);
    return expose(scenes, exposure_factors(settings, scenes, captures), captures, randoms);
}

} // namespace srisp::train
