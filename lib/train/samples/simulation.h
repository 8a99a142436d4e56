// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/samples/photo_inverse.h"
#include "train/samples/simulated_camera.h"

namespace srisp::train {

/// How RAW scenes are made of photos. Defaults: method.md section 6, second series, with uneven light.
struct SimulationSettings {
    PhotoInverseSettings photo;
    LightSettings light;
    double lowest_unevenness = 0, highest_unevenness = 0.9;
    double mixed_light = 0;
    std::string exposure_of = "white";
    double lowest_exposure = 0.06, highest_exposure = 2.5;
    double lowest_flare = 0, highest_flare = 0;
    double lowest_black_error = 0, highest_black_error = 0;
    double lowest_shot = 1e-4, highest_shot = 0.012;
    double lowest_averaged = 1, highest_averaged = 64;

    template<class Visitor> void describe(Visitor& v)
    {
        v.group("photo", photo);
        v.group("light", light);
        v.range("unevenness", lowest_unevenness, highest_unevenness, 0, 3, "deviation of ln light over the scene");
        v.number("mixed_light", mixed_light, 0, 1, "share of scenes in which two lights blend over the scene");
        v.choice("exposure_of", exposure_of, { "white", "percentile" },
                 "what the exposure puts at its value: the photo's white, or the scene's own 97th percentile");
        v.range("exposure", lowest_exposure, highest_exposure, 1e-3, 100,
                "RAW value of green there, 1 is where the sensor clips; drawn evenly in its log");
        v.range("flare", lowest_flare, highest_flare, 0, 0.5, "stray light over the whole scene, in parts of its mean");
        v.range("black_error", lowest_black_error, highest_black_error, -0.1, 0.1, "error of the black level");
        v.range("shot", lowest_shot, highest_shot, 1e-8, 1,
                "shot noise of one sensor pixel, evenly in its log; read "
                "noise goes with it (UPI)");
        v.range("averaged", lowest_averaged, highest_averaged, 1, 1e6,
                "sensor pixels behind one pixel here, evenly in the log: noise variance is divided by it");
    }
};

/// One exposure: a camera, its light, how long. Scenes that share one look as if taken one after the other.
struct Capture {
    int camera = 0;       ///< -1: none of the simulated ones
    CameraColor color;    ///< in the mean of the lights
    Matrix3 difference{}; ///< half of second light minus first, both with white's green at 1; 0 for a single light
    double exposure = 1;
    double black_error = 0, shot = 0, read = 0;     ///< noise variance is shot · v + read
    std::vector<SimulatedCameras::Spectrum> lights; ///< one or two
};

/// A camera among those with `validation`, of which there must be one, and all else; the same numbers are drawn
/// whatever the settings are.
Capture draw_capture(const SimulationSettings& settings, const SimulatedCameras& cameras, bool validation,
                     Random random);

/// [N, 3] (g_r, 1, g_b), [N, 3, 3] white-balanced camera RGB → linear sRGB.
torch::Tensor white_balances(const std::vector<Capture>& captures);
torch::Tensor color_matrices(const std::vector<Capture>& captures);

/// Colour matrices of `count` other training cameras in each capture's light, [N, count, 3, 3]: what a picture may be
/// rendered with. Cameras repeat where there are too few.
torch::Tensor other_color_matrices(const SimulatedCameras& cameras, const std::vector<Capture>& captures, int count,
                                   Randoms& randoms);

/// What reaches the sensor: photos [N, 3, H, W], display-encoded, to camera RGB ≥ 0, neither exposed nor clipped (green
/// of an evenly lit white is 1). On the photos' device.
torch::Tensor camera_scenes(const SimulationSettings& settings, const torch::Tensor& photos,
                            const std::vector<Capture>& captures, const Randoms& randoms);

/// The factor from camera_scenes to RAW, [N, 1, 1, 1].
torch::Tensor exposure_factors(const SimulationSettings& settings, const torch::Tensor& scenes,
                               const std::vector<Capture>& captures);

/// RAW in [0, 1]: scenes times factors, with black level error, noise and clipping.
torch::Tensor expose(const torch::Tensor& scenes, const torch::Tensor& factors, const std::vector<Capture>& captures,
                     const Randoms& randoms);

/// The three steps at once.
torch::Tensor simulate(const SimulationSettings& settings, const torch::Tensor& photos,
                       const std::vector<Capture>& captures, const Randoms& randoms);

} // namespace srisp::train
