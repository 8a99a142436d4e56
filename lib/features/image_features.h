// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/planes.h"

namespace srisp {

/// Three planes whose rows have no gaps.
struct PlanarImage {
    Planes planes;
    int height, width;
};

/// R, G and B of the pixels of a small image, row by row.
using ReducedImage = std::array<std::vector<float>, 3>;

/// Means over blocks of max(1, height / 64) × max(1, width / 64) pixels, whole blocks only: about 64 × 64 of them, so
/// that images of all sizes give about the same numbers.
ReducedImage reduced(const PlanarImage& image);

/// Quantiles of some values, interpolated linearly at q (n − 1). At least one value, none of them NaN. They lie in
/// order of narrow ranges; within one only when a rank in it is asked for.
class Quantiles {
public:
    explicit Quantiles(const std::vector<float>& values);
    double operator()(double q);

private:
    std::size_t range_of(std::uint32_t key) const { return (key - m_least) >> m_shift; }
    /// The value that is greater than `rank` others.
    float ranked(std::size_t rank);

    std::vector<std::uint32_t> m_keys; ///< the values
    std::vector<std::uint32_t> m_ends; ///< where each range ends among them
    std::uint32_t m_least = 0;
    int m_shift = 0;
};

/// 12 numbers of a linear image, R, G, B each: ln(max(mean, 1e-3)); mean of ln(max(v, 1e-3)); ln(max(median, 1e-3));
/// ln(max(98th percentile, 1e-3)); all × 0.5 + 1. Quantiles interpolate linearly at q (count − 1). [method 2]
std::array<float, 12> statistics(Planes image, std::size_t count);

constexpr int kQuantileFeatures = 71;

/// What the anchor's network sees of a linear image, reduced, besides the twelve statistics: of R, G, B and their mean,
/// in this order, the quantiles 0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.995, each as ln(max(q, 1e-4)) × 0.5
/// + 1; then the shares of R, G and B above 0.95; then of the colours ln((R + 0.002) / (G + 0.002)) and the same of B
/// the quantiles 0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98, over all pixels first, then over those whose mean of R, G, B is
/// at or above its quantile 0.75. Quantiles interpolate linearly at q (count − 1).
std::array<float, kQuantileFeatures> quantile_features(const ReducedImage& image);

/// `statistics` of an image and `quantile_features` of its reduction: where that has all of its pixels, they are put in
/// order once for both.
struct ColorFeatures {
    std::array<float, 12> statistics;
    std::array<float, kQuantileFeatures> quantiles;
};
ColorFeatures color_features(const PlanarImage& image, const ReducedImage& small);

} // namespace srisp
