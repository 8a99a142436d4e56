// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "features/image_features.h"

namespace srisp {

constexpr int kMatchFeatures = 51;

/// What match_features needs of a reference alone.
class MatchReference {
public:
    MatchReference(const ReducedImage& reference);

    /// The Fourier transform of its histogram's square roots, in CubeFft's order.
    const std::vector<float>& real() const { return m_real; }
    const std::vector<float>& imaginary() const { return m_imaginary; }

private:
    std::vector<float> m_real, m_imaginary;
};

/// How far a photo's colours must be moved to fall on a reference's: what the anchor's network sees of both images
/// together (their quantiles say where the colours of each lie, not which of them are the same things in other light).
///
/// Of the photo, made linear by a power of 2.2 and reduced, and of the reduced reference. For γ = 1.65, 2.2 and 2.9, 17
/// numbers each: the photo as a typical camera would see it, q = M y^(γ / 2.2), M's rows (0.60, 0.32, 0.08), (0.15,
/// 0.70, 0.15), (0.05, 0.28, 0.67), and the reference have histograms of ln(R / G), ln(B / G) (values ≥ 1e-4) and ln of
/// the mean of R, G, B (≥ 1e-5), 32³ cells of 0.12, 0.12 and 0.25 around 0, 0 and −3; a pixel goes to the eight cells
/// about it by their nearness, coordinates clamped to 0 … 30.99. It weighs √mean, and nothing where a channel is 0.95
/// or more or the mean not above 0.05 of the image's. c(s) is the circular cross-correlation Σ √h_q(x) √h_r(x + s) of
/// the shares h, smoothed by a Gaussian of 0.5 cells, then of 1: p = softmax(25 c / max c) says which shifts s fit.
/// Along each axis the mean of p and its standard deviation, in units of the logarithm, then max c: 7 numbers for each
/// Gaussian. (Where one image has no pixels that weigh, all shifts are as likely and max c is 0.) Then ln of the means
/// of q's three channels (≥ 1e-4).
std::array<float, kMatchFeatures> match_features(const ReducedImage& linear_source, const MatchReference& reference);

} // namespace srisp
