// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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

/// Quantiles of some values, interpolated linearly at q (n − 1). At least one value, none of them NaN.
class Quantiles {
public:
    explicit Quantiles(std::vector<float> values);
    double operator()(double q) const;

private:
    std::vector<float> m_sorted;
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

/// `statistics` of an image and `quantile_features` of its reduction: where that has all of its pixels, they are sorted
/// once for both.
struct ColorFeatures {
    std::array<float, 12> statistics;
    std::array<float, kQuantileFeatures> quantiles;
};
ColorFeatures color_features(const PlanarImage& image, const ReducedImage& small);

} // namespace srisp
