// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <srisp/export.h>
#include <srisp/image.h>

namespace srisp {

/// How far a RAW-like image is from the true one. Images are linear camera RGB; `result` and `truth` must have the same
/// size. Results are taken as a sensor would record them, clamped to [0,1]. All sums are double. Threads: safe. [method
/// 5]

/// Peak signal-to-noise ratio in dB of one image, peak 1, over all channels; infinite where the two are equal.
SRISP_API double psnr(ImageView result, ImageView truth);

/// Structural similarity of one image, peak 1: mean over R, G, B and over all places where the Gaussian window (11 ×
/// 11, σ 1.5) lies within the image. 1 where the two are equal; NaN for images of fewer than 11 pixels a side. [Wang et
/// al. 2004, K1 0.01, K2 0.03]
SRISP_API double ssim(ImageView result, ImageView truth);

/// Angles between the colours of pixels. Add up those of several images with `+=`.
struct AngularError {
    double sum_degrees = 0;
    std::int64_t pixels = 0;  ///< compared
    std::int64_t skipped = 0; ///< a norm below 1e-6: black has no colour

    /// Mean over the compared pixels; NaN where there is none.
    SRISP_API double mean() const;
    SRISP_API AngularError& operator+=(const AngularError& other);
};
SRISP_API AngularError angular_error(ImageView result, ImageView truth);

/// Signed errors of bright values (result − truth, single channels, where truth > 0.8): negative is too dark. Add up
/// those of several images with `+=`.
struct HighlightErrors {
    double sum = 0; ///< as it is
    std::int64_t values = 0;
    double sum_at_gain = 0; ///< after division by the gain g of the whole image with result ≈ g · truth (least
                            ///< squares), fitted to the values where truth is within 0.05 … 0.6
    std::int64_t values_at_gain = 0; ///< fewer than `values` where images had nothing to fit a gain to

    SRISP_API double mean() const;         ///< NaN where there is no bright value
    SRISP_API double mean_at_gain() const; ///< likewise
    SRISP_API HighlightErrors& operator+=(const HighlightErrors& other);
};
SRISP_API HighlightErrors highlight_errors(ImageView result, ImageView truth);

/// ln of an image's brightness: the mean over R, G, B of ln of the channel's mean, which is kept from 0. The difference
/// of two says how much brighter one is: 0.1 is 10 %.
SRISP_API double log_brightness(ImageView image);

/// CIE Lab of an XYZ colour, white D65 (.95047, 1, 1.08883). [CIE 15:2004]
SRISP_API std::array<double, 3> lab_from_xyz(const std::array<double, 3>& xyz);

/// How different two Lab colours look: about 1 is just noticeable. [CIEDE2000: CIE 142-2001; Sharma et al. 2005]
SRISP_API double delta_e2000(const std::array<double, 3>& lab1, const std::array<double, 3>& lab2);
/// Mean over the pixels of two images, under a camera's matrix (row-major 3×3, the inverse of XYZ → camera).
SRISP_API double mean_delta_e2000(ImageView result, ImageView truth, const std::array<float, 9>& camera_to_xyz);

/// How often each value of L, a and b occurs: 512 bins on [−150, 150] per channel; what lies outside counts as the last
/// bin.
class SRISP_API LabHistogram {
public:
    /// Adds the pixels of an image; `camera_to_xyz` is row-major 3×3, the inverse of the XYZ → camera matrix of its
    /// camera.
    void add(ImageView raw, const std::array<float, 9>& camera_to_xyz);

    /// Part that two sets of pixels have in common, 0 … 1: Σ min / 3 of the normalised histograms. 0 where one is
    /// empty.
    double intersection(const LabHistogram& other) const;

    /// How often each bin occurs: those of L, a, b, one after the other.
    const std::vector<std::int64_t>& counts() const { return m_counts; }
    /// Adds what another one counted. `counts`: as that gives them.
    void add_counts(const std::vector<std::int64_t>& counts);

private:
    static constexpr int kBins = 512;
    std::vector<std::int64_t> m_counts = std::vector<std::int64_t>(3 * kBins);
    std::int64_t m_pixels = 0;
};

/// Spearman's rank correlation of two lists of equal length, −1 … 1; equal values share the mean of their ranks. NaN
/// where one of the lists is constant or shorter than two.
SRISP_API double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

} // namespace srisp
