// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scores.h"

namespace srisp::tool {

/// Everything that is measured of a result, in the order of tables. [method 5]
const std::vector<Metric>& metrics();

/// The one with this key; there must be one.
const Metric& metric(const std::string& key);

/// Their keys.
namespace key {
constexpr char kPsnr[] = "psnr_db";
constexpr char kSsim[] = "ssim";
constexpr char kAngle[] = "angle_degrees";
constexpr char kDeltaE[] = "delta_e2000";
constexpr char kLab[] = "lab_intersection";
constexpr char kLabPooled[] = "lab_intersection_all_images";
constexpr char kHighlights[] = "highlight_error";
constexpr char kHighlightsAtGain[] = "highlight_error_at_gain";
constexpr char kBrightness[] = "ln_mean_error";
constexpr char kEdits[] = "edits_psnr_db";
constexpr char kPsnrAtGain[] = "psnr_true_gain_db";
constexpr char kPsnrAtMeans[] = "psnr_true_means_db";
constexpr char kDeviation[] = "brightness_sd_ev";
constexpr char kErrorInDeviations[] = "error_in_deviations";
constexpr char kWithinOne[] = "within_one_deviation";
constexpr char kWithinTwo[] = "within_two_deviations";
constexpr char kRankRed[] = "rank_red", kRankGreen[] = "rank_green", kRankBlue[] = "rank_blue";
} // namespace key

} // namespace srisp::tool
