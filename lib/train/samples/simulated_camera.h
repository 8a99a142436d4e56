// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/matrix3.h"
#include "pack/training_pack.h"
#include "train/tensors/random.h"

namespace srisp::train {

/// Which lights scenes are seen in. Defaults: method.md section 6, second series.
struct LightSettings {
    double daylight = 0.40, artificial = 0.15;
    double lowest_temperature_k = 2300, highest_temperature_k = 11000;
    double lowest_ripple = 0, highest_ripple = 0.15;

    template<class Visitor> void describe(Visitor& v)
    {
        v.number("daylight", daylight, 0, 1, "share of scenes in daylight of the pack");
        v.number("artificial", artificial, 0, 1,
                 "share in fluorescent and LED light of the pack; the rest: black bodies");
        v.range("temperature_k", lowest_temperature_k, highest_temperature_k, 1000, 40000,
                "colour temperature of black bodies, drawn evenly in 1/T");
        v.range("ripple", lowest_ripple, highest_ripple, 0, 0.9,
                "amplitude of the slow ripple on black bodies' spectra");
    }
};

/// What a camera makes of linear sRGB in one light.
struct CameraColor {
    Matrix3 to_camera{};                  ///< linear sRGB → camera RGB; G of white is 1
    std::array<float, 3> white_balance{}; ///< (g_r, 1, g_b): white times this is grey
    Matrix3 color{};                      ///< white-balanced camera RGB → linear sRGB; rows sum to 1
};

/// The colour of a camera from its matrix `to_camera`, of any scale.
CameraColor camera_color(const Matrix3& to_camera);

/// Cameras of a pack, ready to be put into any light: colour = ∫ sensitivity · light · reflectance, where the
/// reflectance stands for a colour of linear sRGB. [method 6; Canon EOS 5D sees white as (0.44, 1, 0.80) under D65]
class SimulatedCameras {
public:
    using Spectrum = std::vector<float>; ///< at the pack's wavelengths

    /// Keeps no reference to the pack.
    explicit SimulatedCameras(const PackedCameras& cameras);

    int count() const { return static_cast<int>(m_validation.size()); }
    const std::vector<bool>& validation() const { return m_validation; }
    /// Whether there is one for validation, or for training.
    bool has(bool validation) const
    {
        return std::find(m_validation.begin(), m_validation.end(), validation) != m_validation.end();
    }
    /// The light of the pack with this name; empty where there is none.
    Spectrum light(const std::string& name) const;
    Spectrum draw_light(const LightSettings& settings, Random& random) const;
    Matrix3 to_camera(int camera, const Spectrum& light) const;

private:
    Spectrum black_body(const LightSettings& settings, Random& random) const;

    std::vector<float> m_wavelengths;
    std::vector<bool> m_validation;
    std::vector<double> m_products; ///< [cameras, 9, wavelengths]: sensitivity × reflectance
    std::vector<std::string> m_light_names;
    std::vector<Spectrum> m_lights;
    std::vector<int> m_daylight, m_artificial; ///< indices of lights
};

} // namespace srisp::train
