// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "features/reduced_image.h"

namespace srisp {

constexpr int kQuantileFeatures = 71;

/// What the anchor's network sees of a linear image, reduced, besides the twelve statistics: of R, G, B and their mean,
/// in this order, the quantiles 0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.995, each as ln(max(q, 1e-4)) × 0.5
/// + 1; then the shares of R, G and B above 0.95; then of the colours ln((R + 0.002) / (G + 0.002)) and the same of B
/// the quantiles 0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98, over all pixels first, then over those whose mean of R, G, B is
/// at or above its quantile 0.75. Quantiles interpolate linearly at q (count − 1).
std::array<float, kQuantileFeatures> quantile_features(const ReducedImage& image);

} // namespace srisp
