// SPDX-License-Identifier: Apache-2.0
#include "features/match_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/matrix3.h"
#include "features/fft.h"

namespace srisp {

namespace {

constexpr int kSide = CubeFft::kSide, kCells = CubeFft::kCells;
constexpr double kGammas[] = { 1.65, 2.2, 2.9 }, kSourceGamma = 2.2;
constexpr Matrix3 kCamera = { 0.60f, 0.32f, 0.08f, 0.15f, 0.70f, 0.15f, 0.05f, 0.28f, 0.67f };

constexpr float kColorCell = 0.12f, kBrightnessCell = 0.25f, kBrightnessCenter = -3;
constexpr float kAxes[] = { kBrightnessCell, kColorCell, kColorCell }; // of a cube: its x, y and z
constexpr int kAxisOrder[] = { 1, 2, 0 };                              // in which the features come
constexpr float kLastCoordinate = 30.99f;
constexpr float kDarkestColor = 1e-4f, kDarkestMean = 1e-5f;
constexpr float kClipped = 0.95f, kDark = 0.05f; // dark: of the image's mean
constexpr float kLeastWeight = 1e-6f;

constexpr double kSmoothing[] = { 0.5, 1 }; // cells
constexpr float kSharpness = 25, kNegligible = -20;
constexpr float kNoMatch = 1e-6f; // least max c: below is rounding

/// As a typical camera would see it.
ReducedImage seen_by_camera(const ReducedImage& linear, double gamma)
{
    const float exponent = static_cast<float>(gamma / kSourceGamma);
    ReducedImage powers = linear, result = linear;
    for (std::vector<float>& channel : powers)
        for (float& v : channel)
            v = std::pow(v, exponent);
    for (std::size_t i = 0; i < powers[0].size(); ++i)
        for (int c = 0; c < 3; ++c)
            result[c][i] =
                kCamera[c * 3] * powers[0][i] + kCamera[c * 3 + 1] * powers[1][i] + kCamera[c * 3 + 2] * powers[2][i];
    return result;
}

double mean(const std::vector<float>& values)
{
    double sum = 0;
    for (const float v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

/// A coordinate's cell and its nearness to the next.
struct Place {
    int cell;
    float next;

    Place(float distance, float cell_size)
    {
        const float coordinate = std::clamp(distance / cell_size + kSide / 2, 0.0f, kLastCoordinate);
        cell = static_cast<int>(coordinate);
        next = coordinate - static_cast<float>(cell);
    }
};

void add(float* cells, const Place& x, const Place& y, const Place& z, float weight)
{
    float* const corner = cells + (x.cell * kSide + y.cell) * kSide + z.cell;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            float* const edge = corner + (i * kSide + j) * kSide;
            const float share = weight * (i ? x.next : 1 - x.next) * (j ? y.next : 1 - y.next);
            edge[0] += share * (1 - z.next);
            edge[1] += share * z.next;
        }
}

/// Square roots of the cells' shares; x: brightness, y: ln(R / G), z: ln(B / G).
std::vector<float> root_histogram(const ReducedImage& image)
{
    const double dark = kDark * (mean(image[0]) + mean(image[1]) + mean(image[2])) / 3;
    std::vector<float> cells(kCells);
    double sum = 0;
    for (std::size_t i = 0; i < image[0].size(); ++i) {
        const float r = image[0][i], g = image[1][i], b = image[2][i];
        const float brightness = (r + g + b) / 3;
        if (std::max({ r, g, b }) >= kClipped || !(brightness > dark))
            continue;
        const float green = std::log(std::max(g, kDarkestColor));
        const float weight = std::sqrt(std::max(brightness, kLeastWeight));
        const Place x(std::log(std::max(brightness, kDarkestMean)) - kBrightnessCenter, kBrightnessCell);
        const Place y(std::log(std::max(r, kDarkestColor)) - green, kColorCell);
        const Place z(std::log(std::max(b, kDarkestColor)) - green, kColorCell);
        add(cells.data(), x, y, z, weight);
        sum += weight;
    }
    const auto scale = static_cast<float>(1 / std::max<double>(sum, kLeastWeight));
    for (float& cell : cells)
        if (cell > 0) // few are
            cell = std::sqrt(cell * scale);
    return cells;
}

/// What the spectrum is multiplied with along one axis, in its order: the Gaussians of kSmoothing, and a third of the
/// transforms' factor.
std::array<std::array<float, kSide>, 2> smoothing()
{
    std::array<std::array<float, kSide>, 2> factors;
    for (int s = 0; s < 2; ++s)
        for (int k = 0; k < kSide; ++k) {
            const double frequency = 2 * M_PI * (k < kSide / 2 ? k : k - kSide) / kSide * kSmoothing[s];
            factors[s][CubeFft::place(k)] = static_cast<float>(std::exp(-0.5 * frequency * frequency) / kSide);
        }
    return factors;
}

/// Where the negative of a frequency is that is at `place`.
std::array<int, kSide> opposite_places()
{
    std::array<int, kSide> places;
    for (int k = 0; k < kSide; ++k)
        places[CubeFft::place(k)] = CubeFft::place((kSide - k) % kSide);
    return places;
}

/// From two real cubes as real and imaginary part of one to their cross-correlation, smoothed by the first Gaussian (in
/// the real part) and by the second (in the imaginary one). Spectra of real cubes have opposite frequencies conjugate,
/// so two pass through each transform.
void correlate(CubeFft& cube)
{
    static const auto smooth = smoothing();
    static const auto opposite = opposite_places();
    cube.forward();
    float *const re = cube.real(), *const im = cube.imaginary();
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y)
            for (int z = 0; z < kSide; ++z) {
                const int i = (x * kSide + y) * kSide + z;
                const int j = (opposite[x] * kSide + opposite[y]) * kSide + opposite[z];
                if (j < i)
                    continue; // was done with its opposite
                // 2 Q = Z(k) + conj Z(−k), 2i R = Z(k) − conj Z(−k)
                const float qr = re[i] + re[j], qi = im[i] - im[j], rr = im[i] + im[j], ri = re[j] - re[i];
                const float product_re = 0.25f * (qr * rr + qi * ri), product_im = 0.25f * (qr * ri - qi * rr);
                const float narrow = smooth[0][x] * smooth[0][y] * smooth[0][z];
                const float wide = smooth[1][x] * smooth[1][y] * smooth[1][z];
                re[i] = product_re * narrow - product_im * wide;
                im[i] = product_im * narrow + product_re * wide;
                re[j] = product_re * narrow + product_im * wide;
                im[j] = product_re * wide - product_im * narrow;
            }
    cube.inverse();
}

/// Of kCells values; in a way that compilers vectorise.
float largest(const float* values)
{
    std::array<float, 16> columns{};
    for (int i = 0; i < kCells; i += 16)
        for (int k = 0; k < 16; ++k)
            columns[k] = values[i + k] > columns[k] ? values[i + k] : columns[k];
    return *std::max_element(columns.begin(), columns.end());
}

/// Which shifts fit: 7 numbers.
float* describe_peak(float* correlation, float* features)
{
    float peak = largest(correlation);
    if (peak < kNoMatch) {
        std::fill_n(correlation, kCells, 0.0f);
        peak = 0;
    }
    const float scale = kSharpness / std::max(peak, kNoMatch);
    double sums[3][kSide] = {}, all = 0;
    for (int i = 0; i < kCells; ++i) {
        const float exponent = (correlation[i] - peak) * scale;
        if (exponent < kNegligible)
            continue;
        const double p = std::exp(exponent);
        sums[0][i / kSide / kSide] += p;
        sums[1][i / kSide % kSide] += p;
        sums[2][i % kSide] += p;
        all += p;
    }
    for (const int axis : kAxisOrder) {
        double first = 0, second = 0;
        for (int k = 0; k < kSide; ++k) {
            const int shift = k < kSide / 2 ? k : k - kSide;
            first += sums[axis][k] / all * shift;
            second += sums[axis][k] / all * shift * shift;
        }
        *features++ = static_cast<float>(first * kAxes[axis]);
        *features++ = static_cast<float>(std::sqrt(std::max(second - first * first, 0.0)) * kAxes[axis]);
    }
    *features++ = peak;
    return features;
}

} // namespace

std::array<float, kMatchFeatures> match_features(const ReducedImage& linear_source, const ReducedImage& reference)
{
    const std::vector<float> reference_roots = root_histogram(reference);
    std::array<float, kMatchFeatures> features;
    float* next = features.data();
    CubeFft cube;
    for (const double gamma : kGammas) {
        const ReducedImage seen = seen_by_camera(linear_source, gamma);
        const std::vector<float> roots = root_histogram(seen);
        std::copy(roots.begin(), roots.end(), cube.real());
        std::copy(reference_roots.begin(), reference_roots.end(), cube.imaginary());
        correlate(cube);
        next = describe_peak(cube.real(), next);
        next = describe_peak(cube.imaginary(), next);
        for (const std::vector<float>& channel : seen)
            *next++ = static_cast<float>(std::log(std::max(mean(channel), 1e-4)));
    }
    return features;
}

} // namespace srisp
