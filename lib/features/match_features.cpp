// SPDX-License-Identifier: Apache-2.0
#include "features/match_features.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "base/matrix3.h"
#include "features/fft.h"
#include "features/lanes.h"
#include "features/sums.h"

namespace srisp {

namespace {

constexpr int kSide = CubeFft::kSide, kFloats = CubeFft::kFloats;
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

std::size_t whole_lanes(std::size_t count)
{
    return (count + kLanes - 1) / kLanes * kLanes;
}

/// ln of each of whole lanes of values, in place.
SRISP_WIDE_LANES void take_logs(float* values, std::size_t count)
{
    for (std::size_t i = 0; i < count; i += kLanes) {
        Lanes v;
        load(values + i, v);
        raise(v, std::numeric_limits<float>::min());
        take_log(v);
        store(v, values + i);
    }
}

/// ln of an image's values; 0 up to whole lanes.
ReducedImage logarithms(ReducedImage image)
{
    for (std::vector<float>& channel : image) {
        channel.resize(whole_lanes(channel.size()), 1.0f);
        take_logs(channel.data(), channel.size());
    }
    return image;
}

/// R, G and B of whole lanes of pixels.
using Channels = std::array<float*, 3>;
using ConstChannels = std::array<const float*, 3>;

SRISP_WIDE_LANES void see_by_camera(const ConstChannels& logs, float exponent, std::size_t count,
                                    const Channels& result)
{
    for (std::size_t i = 0; i < count; i += kLanes) {
        Lanes v[3];
        for (int c = 0; c < 3; ++c) {
            load(logs[c] + i, v[c]);
            v[c] *= exponent;
            take_exp(v[c]);
        }
        for (int c = 0; c < 3; ++c)
            store(kCamera[c * 3] * v[0] + kCamera[c * 3 + 1] * v[1] + kCamera[c * 3 + 2] * v[2], result[c] + i);
    }
}

/// As a typical camera would see it. `logs`: of the linear image.
void see_by_camera(const ReducedImage& logs, double gamma, ReducedImage& result)
{
    see_by_camera({ logs[0].data(), logs[1].data(), logs[2].data() }, static_cast<float>(gamma / kSourceGamma),
                  logs[0].size(), { result[0].data(), result[1].data(), result[2].data() });
}

using Means = std::array<double, 3>;

/// Of the first `count` pixels.
Means means_of(const ReducedImage& image, std::size_t count)
{
    Means means;
    for (int c = 0; c < 3; ++c)
        means[c] = sum_of(image[c].data(), count) / static_cast<double>(count);
    return means;
}

inline __attribute__((always_inline)) void to_coordinate(Lanes& distance, float cell_size)
{
    distance = distance / cell_size + float(kSide / 2);
    raise(distance, 0);
    limit(distance, kLastCoordinate);
}

/// Where pixels lie among the cells, and the square of what they weigh. x: brightness, y: ln(R / G), z: ln(B / G).
struct Places {
    float x[kLanes], y[kLanes], z[kLanes], weight[kLanes];
};

/// Of whole lanes of pixels.
SRISP_WIDE_LANES void find_places(const ConstChannels& image, std::size_t count, float dark, Places* places)
{
    for (std::size_t i = 0; i < count; i += kLanes, ++places) {
        Lanes rgb[3];
        for (int c = 0; c < 3; ++c)
            load(image[c] + i, rgb[c]);
        Lanes brightness = (rgb[0] + rgb[1] + rgb[2]) / 3.0f, weight = brightness;
        const IntLanes weighs = (rgb[0] < kClipped) & (rgb[1] < kClipped) & (rgb[2] < kClipped) & (brightness > dark);
        raise(weight, kLeastWeight);
        store(weighs ? weight : Lanes{}, places->weight);
        for (Lanes& v : rgb) {
            raise(v, kDarkestColor);
            take_log(v);
        }
        raise(brightness, kDarkestMean);
        take_log(brightness);
        Lanes x = brightness - kBrightnessCenter, y = rgb[0] - rgb[1], z = rgb[2] - rgb[1];
        to_coordinate(x, kBrightnessCell);
        to_coordinate(y, kColorCell);
        to_coordinate(z, kColorCell);
        store(x, places->x);
        store(y, places->y);
        store(z, places->z);
    }
}

/// A coordinate's cell and its nearness to the next.
struct Place {
    int cell;
    float next;

    explicit Place(float coordinate) : cell(static_cast<int>(coordinate)), next(coordinate - static_cast<float>(cell))
    {
    }
};

typedef float Pair __attribute__((vector_size(2 * sizeof(float))));

void add(float* cells, const Place& x, const Place& y, const Place& z, float weight)
{
    const Pair shares{ 1 - z.next, z.next };
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            float* const edge = cells + CubeFft::at(x.cell + i, y.cell + j, z.cell);
            Pair sum;
            std::memcpy(&sum, edge, sizeof sum);
            sum += weight * (i ? x.next : 1 - x.next) * (j ? y.next : 1 - y.next) * shares;
            std::memcpy(edge, &sum, sizeof sum);
        }
}

bool are_zeros(const float* lanes)
{
    constexpr float kZeros[kLanes] = {};
    return std::memcmp(lanes, kZeros, sizeof kZeros) == 0;
}

/// Square roots of the cells' shares. `image`: whole lanes of pixels, of which the first `count` are taken.
void root_histogram(const ReducedImage& image, std::size_t count, const Means& means, float* cells)
{
    const double dark = kDark * (means[0] + means[1] + means[2]) / 3;
    std::vector<Places> all(image[0].size() / kLanes);
    find_places({ image[0].data(), image[1].data(), image[2].data() }, image[0].size(), static_cast<float>(dark),
                all.data());
    std::fill_n(cells, kFloats, 0.0f);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Places& places = all[i / kLanes];
        const std::size_t k = i % kLanes;
        if (!(places.weight[k] > 0))
            continue;
        const float weight = std::sqrt(places.weight[k]);
        add(cells, Place(places.x[k]), Place(places.y[k]), Place(places.z[k]), weight);
        sum += weight;
    }
    const auto scale = static_cast<float>(1 / std::max<double>(sum, kLeastWeight));
    for (float* some = cells; some < cells + kFloats; some += kLanes)
        if (!are_zeros(some)) // most are
            for (int k = 0; k < kLanes; ++k)
                some[k] = std::sqrt(some[k] * scale);
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

/// From a real cube to its cross-correlation with the reference, smoothed by the first Gaussian (in the real part) and
/// by the second (in the imaginary one).
void correlate(CubeFft& cube, const MatchReference& reference)
{
    static const auto smooth = smoothing();
    cube.forward();
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y) {
            const int row = CubeFft::at(x, y, 0);
            float *const re = cube.real() + row, *const im = cube.imaginary() + row;
            const float* const other_re = reference.real().data() + row;
            const float* const other_im = reference.imaginary().data() + row;
            const float narrow_xy = smooth[0][x] * smooth[0][y], wide_xy = smooth[1][x] * smooth[1][y];
            for (int z = 0; z < kSide; ++z) {
                const float product_re = re[z] * other_re[z] + im[z] * other_im[z];
                const float product_im = re[z] * other_im[z] - im[z] * other_re[z];
                const float narrow = narrow_xy * smooth[0][z], wide = wide_xy * smooth[1][z];
                re[z] = product_re * narrow - product_im * wide;
                im[z] = product_im * narrow + product_re * wide;
            }
        }
    cube.inverse();
}

/// Of a row of values; of no less than 0.
inline __attribute__((always_inline)) float largest(const float* values, int count)
{
    Lanes most = {};
    for (int i = 0; i < count; i += kLanes) {
        Lanes v;
        load(values + i, v);
        most = v > most ? v : most;
    }
    float result = 0;
    for (int k = 0; k < kLanes; ++k)
        result = std::max(result, most[k]);
    return result;
}

/// Sums of p = exp((c − peak) · scale) along the axes, and of all.
struct Shares {
    double along[3][kSide] = {}, all = 0;
};

SRISP_WIDE_LANES Shares shares_of(const float* correlation, float peak, float scale)
{
    constexpr int kBlocks = kSide / kLanes;
    Shares shares;
    Lanes columns[kBlocks] = {};
    for (int row = 0; row < kSide * kSide; ++row) {
        const int x = row / kSide, y = row % kSide;
        const float* const values = correlation + CubeFft::at(x, y, 0);
        if ((largest(values, kSide) - peak) * scale < kNegligible)
            continue; // most rows are so
        Lanes sum = {};
        for (int block = 0; block < kBlocks; ++block) {
            Lanes exponent;
            load(values + block * kLanes, exponent);
            exponent = (exponent - peak) * scale;
            const IntLanes negligible = exponent < kNegligible;
            take_exp(exponent);
            exponent = negligible ? Lanes{} : exponent;
            columns[block] += exponent;
            sum += exponent;
        }
        double row_sum = 0;
        for (int k = 0; k < kLanes; ++k)
            row_sum += sum[k];
        shares.along[0][x] += row_sum;
        shares.along[1][y] += row_sum;
        shares.all += row_sum;
    }
    for (int z = 0; z < kSide; ++z)
        shares.along[2][z] = columns[z / kLanes][z % kLanes];
    return shares;
}

SRISP_WIDE_LANES float peak_of(const float* correlation)
{
    return largest(correlation, kFloats);
}

/// Which shifts fit: 7 numbers.
float* describe_peak(float* correlation, float* features)
{
    float peak = peak_of(correlation);
    if (peak < kNoMatch) {
        std::fill_n(correlation, kFloats, 0.0f);
        peak = 0;
    }
    const Shares shares = shares_of(correlation, peak, kSharpness / std::max(peak, kNoMatch));
    for (const int axis : kAxisOrder) {
        double first = 0, second = 0;
        for (int k = 0; k < kSide; ++k) {
            const int shift = k < kSide / 2 ? k : k - kSide;
            first += shares.along[axis][k] / shares.all * shift;
            second += shares.along[axis][k] / shares.all * shift * shift;
        }
        *features++ = static_cast<float>(first * kAxes[axis]);
        *features++ = static_cast<float>(std::sqrt(std::max(second - first * first, 0.0)) * kAxes[axis]);
    }
    *features++ = peak;
    return features;
}

} // namespace

MatchReference::MatchReference(const ReducedImage& reference)
{
    CubeFft cube;
    const std::size_t count = reference[0].size();
    ReducedImage image = reference;
    for (std::vector<float>& channel : image)
        channel.resize(whole_lanes(count));
    root_histogram(image, count, means_of(reference, count), cube.real());
    cube.forward();
    m_real.assign(cube.real(), cube.real() + kFloats);
    m_imaginary.assign(cube.imaginary(), cube.imaginary() + kFloats);
}

std::array<float, kMatchFeatures> match_features(const ReducedImage& linear_source, const MatchReference& reference)
{
    const std::size_t count = linear_source[0].size();
    const ReducedImage logs = logarithms(linear_source);
    ReducedImage seen = logs;
    std::array<float, kMatchFeatures> features;
    float* next = features.data();
    CubeFft cube;
    for (const double gamma : kGammas) {
        see_by_camera(logs, gamma, seen);
        const Means means = means_of(seen, count);
        root_histogram(seen, count, means, cube.real());
        std::fill_n(cube.imaginary(), kFloats, 0.0f);
        correlate(cube, reference);
        next = describe_peak(cube.real(), next);
        next = describe_peak(cube.imaginary(), next);
        for (const double mean : means)
            *next++ = static_cast<float>(std::log(std::max(mean, 1e-4)));
    }
    return features;
}

} // namespace srisp
