// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <srisp/metrics.h>

namespace srisp {

namespace {

constexpr double kDegree = M_PI / 180;

double pow7(double value)
{
    return value * value * value * value * value * value * value;
}

/// √(c⁷ / (c⁷ + 25⁷))
double chroma_weight(double chroma)
{
    return std::sqrt(pow7(chroma) / (pow7(chroma) + pow7(25)));
}

/// Of (b, a′) in 0 … 360 degrees; of grey 0.
double hue(double b, double a)
{
    if (a == 0 && b == 0)
        return 0;
    const double degrees = std::atan2(b, a) / kDegree;
    return degrees < 0 ? degrees + 360 : degrees;
}

std::array<double, 3> lab_of(const float* raw, const std::array<float, 9>& camera_to_xyz)
{
    std::array<double, 3> xyz;
    for (std::size_t row = 0; row < 3; ++row) {
        xyz[row] = 0;
        for (std::size_t c = 0; c < 3; ++c)
            xyz[row] += double(camera_to_xyz[row * 3 + c]) * std::clamp(raw[c], 0.0f, 1.0f);
    }
    return lab_from_xyz(xyz);
}

} // namespace

double delta_e2000(const std::array<double, 3>& lab1, const std::array<double, 3>& lab2)
{
    const double c_mean = (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])) / 2;
    const double g = 0.5 * (1 - chroma_weight(c_mean));
    const double a1 = lab1[1] * (1 + g), a2 = lab2[1] * (1 + g);
    const double c1 = std::hypot(a1, lab1[2]), c2 = std::hypot(a2, lab2[2]);
    const double h1 = hue(lab1[2], a1), h2 = hue(lab2[2], a2);
    const bool coloured = c1 * c2 != 0;
    double turn = h2 - h1;
    if (turn > 180)
        turn -= 360;
    else if (turn < -180)
        turn += 360;
    const double dl = lab2[0] - lab1[0], dc = c2 - c1;
    const double dh = coloured ? 2 * std::sqrt(c1 * c2) * std::sin(turn / 2 * kDegree) : 0;
    const double l = (lab1[0] + lab2[0]) / 2, c = (c1 + c2) / 2;
    double h = h1 + h2;
    if (coloured)
        h = std::abs(h1 - h2) <= 180 ? h / 2 : (h < 360 ? (h + 360) / 2 : (h - 360) / 2);
    const double t = 1 - 0.17 * std::cos((h - 30) * kDegree) + 0.24 * std::cos(2 * h * kDegree) +
                     0.32 * std::cos((3 * h + 6) * kDegree) - 0.20 * std::cos((4 * h - 63) * kDegree);
    const double l50 = (l - 50) * (l - 50);
    const double sl = 1 + 0.015 * l50 / std::sqrt(20 + l50), sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
    const double rotation = 30 * std::exp(-((h - 275) / 25) * ((h - 275) / 25));
    const double rt = -std::sin(2 * rotation * kDegree) * 2 * chroma_weight(c);
    return std::sqrt(dl / sl * (dl / sl) + dc / sc * (dc / sc) + dh / sh * (dh / sh) + rt * (dc / sc) * (dh / sh));
}

double mean_delta_e2000(ImageView result, ImageView truth, const std::array<float, 9>& camera_to_xyz)
{
    double sum = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            sum += delta_e2000(lab_of(result.pixel(x, y), camera_to_xyz), lab_of(truth.pixel(x, y), camera_to_xyz));
    return sum / (double(truth.width) * truth.height);
}

} // namespace srisp
