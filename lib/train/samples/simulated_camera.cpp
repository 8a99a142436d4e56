// SPDX-License-Identifier: Apache-2.0
#include "train/samples/simulated_camera.h"

#include <cmath>

namespace srisp::train {

CameraColor camera_color(const Matrix3& to_camera)
{
    CameraColor color;
    std::array<double, 3> white{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            white[row] += to_camera[row * 3 + column];
    Matrix3 balanced;
    for (int row = 0; row < 3; ++row) {
        color.white_balance[row] = static_cast<float>(white[1] / white[row]);
        for (int column = 0; column < 3; ++column) {
            color.to_camera[row * 3 + column] = static_cast<float>(to_camera[row * 3 + column] / white[1]);
            balanced[row * 3 + column] = static_cast<float>(to_camera[row * 3 + column] / white[row]);
        }
    }
    color.color = row_normalized(inverse(balanced));
    return color;
}

SimulatedCameras::SimulatedCameras(const PackedCameras& cameras)
    : m_wavelengths(cameras.wavelengths), m_validation(cameras.validation), m_light_names(cameras.light_names)
{
    const auto count = m_wavelengths.size();
    for (std::size_t camera = 0; camera < m_validation.size(); ++camera)
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                for (std::size_t i = 0; i < count; ++i)
                    m_products.push_back(double(cameras.sensitivities[(camera * 3 + row) * count + i]) *
                                         cameras.reflectance[column * count + i]);
    for (std::size_t i = 0; i < cameras.light_names.size(); ++i) {
        m_lights.emplace_back(cameras.lights.begin() + i * count, cameras.lights.begin() + (i + 1) * count);
        const std::string& kind = cameras.light_kinds[i];
        if (kind == "daylight")
            m_daylight.push_back(static_cast<int>(i));
        else if (kind == "fluorescent" || kind == "led")
            m_artificial.push_back(static_cast<int>(i));
    }
}

SimulatedCameras::Spectrum SimulatedCameras::light(const std::string& name) const
{
    for (std::size_t i = 0; i < m_lights.size(); ++i)
        if (m_light_names[i] == name)
            return m_lights[i];
    return {};
}

SimulatedCameras::Spectrum SimulatedCameras::draw_light(const LightSettings& settings, Random& random) const
{
    const double kind = random.uniform();
    if (kind < settings.daylight && !m_daylight.empty())
        return m_lights[m_daylight[random.integer(m_daylight.size())]];
    if (kind >= settings.daylight && kind < settings.daylight + settings.artificial && !m_artificial.empty())
        return m_lights[m_artificial[random.integer(m_artificial.size())]];
    return black_body(settings, random);
}

SimulatedCameras::Spectrum SimulatedCameras::black_body(const LightSettings& settings, Random& random) const
{
    constexpr double kPi = 3.14159265358979323846;
    constexpr double kSecondRadiation_nm_k = 1.438776877e7; // hc/k, CODATA 2018
    const double temperature =
        1 / random.uniform(1 / settings.highest_temperature_k, 1 / settings.lowest_temperature_k);
    const double ripple = random.uniform(settings.lowest_ripple, settings.highest_ripple);
    const double period_nm = random.uniform(100, 400), phase = random.uniform(0, 2 * kPi);
    Spectrum spectrum;
    for (const float wavelength : m_wavelengths) {
        const double planck = std::pow(wavelength / 560.0, -5) /
                              std::expm1(kSecondRadiation_nm_k / (wavelength * temperature)) *
                              std::expm1(kSecondRadiation_nm_k / (560 * temperature));
        spectrum.push_back(
            static_cast<float>(planck * (1 + ripple * std::sin(2 * kPi * wavelength / period_nm + phase))));
    }
    return spectrum;
}

Matrix3 SimulatedCameras::to_camera(int camera, const Spectrum& light) const
{
    Matrix3 matrix;
    const std::size_t count = m_wavelengths.size();
    for (std::size_t entry = 0; entry < 9; ++entry) {
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            sum += m_products[(camera * 9 + entry) * count + i] * light[i];
        matrix[entry] = static_cast<float>(sum);
    }
    return matrix;
}

} // namespace srisp::train
