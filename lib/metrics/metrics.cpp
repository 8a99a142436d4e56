// SPDX-License-Identifier: Apache-2.0
#include <srisp/metrics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace srisp {

namespace {

constexpr double kSmallestNorm = 1e-6;
constexpr float kBright = 0.8f;
constexpr float kGainLow = 0.05f, kGainHigh = 0.6f;

double recorded(float value)
{
    return std::clamp(value, 0.0f, 1.0f);
}

/// Calls `visit(result pixel, truth pixel)` for every pixel.
template<class Visit> void for_each_pixel(ImageView result, ImageView truth, Visit visit)
{
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            visit(result.pixel(x, y), truth.pixel(x, y));
}

double ratio(double sum, std::int64_t count)
{
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

double log_brightness(ImageView image)
{
    constexpr double kSmallest = 1e-5;
    double sums[3] = {};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                sums[c] += image.pixel(x, y)[c];
    double sum = 0;
    for (const double channel : sums)
        sum += std::log(std::max(channel / (double(image.width) * image.height), kSmallest));
    return sum / 3;
}

double psnr(ImageView result, ImageView truth)
{
    double sum = 0;
    for_each_pixel(result, truth, [&](const float* r, const float* t) {
        for (int c = 0; c < 3; ++c) {
            const double difference = recorded(r[c]) - t[c];
            sum += difference * difference;
        }
    });
    return -10 * std::log10(sum / (3.0 * truth.width * truth.height));
}

double AngularError::mean() const
{
    return ratio(sum_degrees, pixels);
}

AngularError& AngularError::operator+=(const AngularError& other)
{
    sum_degrees += other.sum_degrees;
    pixels += other.pixels;
    skipped += other.skipped;
    return *this;
}

AngularError angular_error(ImageView result, ImageView truth)
{
    AngularError error;
    for_each_pixel(result, truth, [&](const float* r, const float* t) {
        double dot = 0, result_square = 0, truth_square = 0;
        for (int c = 0; c < 3; ++c) {
            const double value = recorded(r[c]);
            dot += value * t[c];
            result_square += value * value;
            truth_square += double(t[c]) * t[c];
        }
        const double result_norm = std::sqrt(result_square), truth_norm = std::sqrt(truth_square);
        if (result_norm < kSmallestNorm || truth_norm < kSmallestNorm) {
            ++error.skipped;
            return;
        }
        ++error.pixels;
        error.sum_degrees += std::acos(std::clamp(dot / (result_norm * truth_norm), -1.0, 1.0)) * 180 / M_PI;
    });
    return error;
}

double HighlightErrors::mean() const
{
    return ratio(sum, values);
}

double HighlightErrors::mean_at_gain() const
{
    return ratio(sum_at_gain, values_at_gain);
}

HighlightErrors& HighlightErrors::operator+=(const HighlightErrors& other)
{
    sum += other.sum;
    values += other.values;
    sum_at_gain += other.sum_at_gain;
    values_at_gain += other.values_at_gain;
    return *this;
}

HighlightErrors highlight_errors(ImageView result, ImageView truth)
{
    HighlightErrors errors;
    double bright_result = 0, bright_truth = 0, product = 0, square = 0;
    for_each_pixel(result, truth, [&](const float* r, const float* t) {
        for (int c = 0; c < 3; ++c) {
            const double value = recorded(r[c]);
            if (t[c] > kBright) {
                bright_result += value;
                bright_truth += t[c];
                ++errors.values;
            } else if (t[c] >= kGainLow && t[c] <= kGainHigh) {
                product += value * t[c];
                square += double(t[c]) * t[c];
            }
        }
    });
    errors.sum = bright_result - bright_truth;
    if (product > 0) {
        errors.sum_at_gain = bright_result * square / product - bright_truth;
        errors.values_at_gain = errors.values;
    }
    return errors;
}

std::array<double, 3> lab_from_xyz(const std::array<double, 3>& xyz)
{
    constexpr double white[] = { 0.95047, 1, 1.08883 };
    constexpr double linear_below = 216.0 / 24389, slope = 841.0 / 108; // (6/29)³ and (29/6)²/3 of the standard
    double f[3];
    for (int c = 0; c < 3; ++c) {
        const double t = xyz[c] / white[c];
        f[c] = t > linear_below ? std::cbrt(t) : slope * t + 4.0 / 29;
    }
    return { 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2]) };
}

void LabHistogram::add(ImageView raw, const std::array<float, 9>& camera_to_xyz)
{
    constexpr double low = -150, high = 150;
    for_each_pixel(raw, raw, [&](const float* v, const float*) {
        std::array<double, 3> xyz;
        for (int row = 0; row < 3; ++row)
            xyz[row] = double(camera_to_xyz[row * 3]) * v[0] + double(camera_to_xyz[row * 3 + 1]) * v[1] +
                       double(camera_to_xyz[row * 3 + 2]) * v[2];
        const std::array<double, 3> lab = lab_from_xyz(xyz);
        for (int c = 0; c < 3; ++c) {
            const double bin = (lab[c] - low) / (high - low) * kBins;
            // What is not a number falls into the first bin, too.
            ++m_counts[c * kBins + (bin > 0 ? static_cast<int>(std::min(bin, kBins - 1.0)) : 0)];
        }
    });
    m_pixels += std::int64_t(raw.width) * raw.height;
}

void LabHistogram::add_counts(const std::vector<std::int64_t>& counts)
{
    for (std::size_t i = 0; i < m_counts.size(); ++i)
        m_counts[i] += counts.at(i);
    m_pixels += std::accumulate(counts.begin(), counts.begin() + kBins, std::int64_t(0));
}

double LabHistogram::intersection(const LabHistogram& other) const
{
    if (m_pixels == 0 || other.m_pixels == 0)
        return 0;
    double sum = 0;
    for (std::size_t i = 0; i < m_counts.size(); ++i)
        sum += std::min(static_cast<double>(m_counts[i]) / m_pixels,
                        static_cast<double>(other.m_counts[i]) / other.m_pixels);
    return sum / 3;
}

/// Each value's place in the sorted list, from 0; the mean place where several are equal.
static std::vector<double> ranks(const std::vector<double>& values)
{
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
    std::vector<double> result(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]])
            ++end;
        for (std::size_t i = first; i < end; ++i)
            result[order[i]] = (first + end - 1) / 2.0;
        first = end;
    }
    return result;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    const std::vector<double> rank_a = ranks(a), rank_b = ranks(b);
    const double middle = (static_cast<double>(a.size()) - 1) / 2;
    double product = 0, square_a = 0, square_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        product += (rank_a[i] - middle) * (rank_b[i] - middle);
        square_a += (rank_a[i] - middle) * (rank_a[i] - middle);
        square_b += (rank_b[i] - middle) * (rank_b[i] - middle);
    }
    return product / std::sqrt(square_a * square_b);
}

} // namespace srisp
