// SPDX-License-Identifier: Apache-2.0
#include "measure.h"

#include <algorithm>
#include <cmath>

#include "base/hashes.h"
#include "metric_table.h"
#include "rendering/test_rendering.h"

namespace srisp::tool {

namespace {

constexpr double kMostDb = 100; // a result that is the truth itself; packs' 16 bits end there, too

double db(double psnr)
{
    return std::min(psnr, kMostDb);
}

/// A value of one image.
Measured one(double value)
{
    return std::isfinite(value) ? Measured{ value, 1 } : Measured{};
}

/// The result times one gain for each channel.
Pixels scaled(const Pixels& pixels, const std::array<double, 3>& gains)
{
    Pixels result = pixels;
    for (std::size_t i = 0; i < result.rgb.size(); ++i)
        result.rgb[i] = std::clamp(float(result.rgb[i] * gains[i % 3]), 0.0f, 1.0f);
    return result;
}

/// Gains that give the truth's means; `alike`: one for all channels.
std::array<double, 3> true_gains(const Pixels& result, const Pixels& truth, bool alike)
{
    constexpr double kSmallest = 1e-6;
    std::array<double, 3> have = result.means(), want = truth.means();
    if (alike) {
        have.fill((have[0] + have[1] + have[2]) / 3);
        want.fill((want[0] + want[1] + want[2]) / 3);
    }
    for (std::size_t c = 0; c < 3; ++c)
        want[c] /= std::max(have[c], kSmallest);
    return want;
}

/// PSNR in sRGB after both were rendered alike, in ways that the truth and the seed decide.
double psnr_after_edits(const TestImage& image, const Pixels& result, const MeasureSettings& settings)
{
    const RawScene scene{ image.truth.view(), image.colors.white_balance, image.colors.to_srgb };
    const std::string name = image.score.image + "/" + image.score.part;
    double sum = 0;
    Pixels of_truth(image.truth.width, image.truth.height), of_result = of_truth;
    for (int k = 0; k < settings.edits; ++k) {
        const TestRendering edit =
            random_rendering(scene, dnd_camera_to_rgb(), Random(seeded_hash(settings.seed, name), 0, std::uint64_t(k)));
        render(edit, image.truth.view(), of_truth.mutable_view());
        render(edit, result.view(), of_result.mutable_view());
        sum += db(psnr(of_result.view(), of_truth.view()));
    }
    return sum / settings.edits;
}

int level_of(float truth)
{
    if (truth <= 0)
        return 0;
    return std::clamp(kLevels + int(std::floor(std::log2(truth))), 0, kLevels - 1);
}

std::array<Measured, kLevels> errors_by_level(const Pixels& result, const Pixels& truth)
{
    std::array<Measured, kLevels> levels{};
    for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
        Measured& level = levels[std::size_t(level_of(truth.rgb[i]))];
        level.sum += double(result.rgb[i]) - truth.rgb[i];
        level.weight += 1;
    }
    return levels;
}

Measured lab_intersection(ImageView result, ImageView wanted, const Matrix3& to_xyz, LabCounts* lab)
{
    LabHistogram of_result, of_wanted;
    of_result.add(result, to_xyz);
    of_wanted.add(wanted, to_xyz);
    if (lab)
        *lab = { of_result.counts(), of_wanted.counts() };
    return one(of_result.intersection(of_wanted));
}

void measure_deviation(MethodScore& score, double log_error, float log_deviation)
{
    const double error = std::fabs(log_error) / std::max(log_deviation, 1e-6f);
    score.values[key::kDeviation] = one(log_deviation / std::log(2.0));
    score.values[key::kErrorInDeviations] = one(error);
    score.values[key::kWithinOne] = { error <= 1 ? 1.0 : 0.0, 1 };
    score.values[key::kWithinTwo] = { error <= 2 ? 1.0 : 0.0, 1 };
}

} // namespace

std::optional<Chromaticity> chromaticity_of(const Pixels& pixels)
{
    const auto means = pixels.means();
    if (*std::min_element(means.begin(), means.end()) <= 0)
        return {};
    return Chromaticity{ std::log(means[0] / means[1]), std::log(means[2] / means[1]) };
}

MethodScore measure_result(const TestImage& image, const MethodResult& result, const MeasureSettings& settings,
                           LabCounts* lab)
{
    const ImageView raw = result.raw.view(), truth = image.truth.view();
    MethodScore score;
    score.parameters = result.parameters;
    score.chromaticity = chromaticity_of(result.raw);
    score.error_by_level = errors_by_level(result.raw, image.truth);
    score.values[key::kPsnr] = one(db(psnr(raw, truth)));
    score.values[key::kSsim] = one(ssim(raw, truth));
    const AngularError angle = angular_error(raw, truth);
    score.values[key::kAngle] = { angle.sum_degrees, double(angle.pixels) };
    if (image.colors.to_xyz) {
        score.values[key::kDeltaE] = one(mean_delta_e2000(raw, truth, *image.colors.to_xyz));
        score.values[key::kLab] = lab_intersection(raw, truth, *image.colors.to_xyz, lab);
    }
    const double log_error = log_brightness(raw) - log_brightness(truth);
    score.values[key::kBrightness] = one(log_error);
    const HighlightErrors highlights = highlight_errors(raw, truth);
    score.values[key::kHighlights] = { highlights.sum, double(highlights.values) };
    score.values[key::kHighlightsAtGain] = { highlights.sum_at_gain, double(highlights.values_at_gain) };
    if (settings.edits > 0)
        score.values[key::kEdits] = one(psnr_after_edits(image, result.raw, settings));
    score.values[key::kPsnrAtGain] =
        one(db(psnr(scaled(result.raw, true_gains(result.raw, image.truth, true)).view(), truth)));
    score.values[key::kPsnrAtMeans] =
        one(db(psnr(scaled(result.raw, true_gains(result.raw, image.truth, false)).view(), truth)));
    if (result.log_deviation)
        measure_deviation(score, log_error, *result.log_deviation);
    return score;
}

MethodScore measure_unpaired(const TestImage& image, const MethodResult& result, LabCounts* lab)
{
    MethodScore score;
    score.parameters = result.parameters;
    score.chromaticity = chromaticity_of(result.raw);
    if (image.colors.to_xyz)
        score.values[key::kLab] =
            lab_intersection(result.raw.view(), image.reference.view(), *image.colors.to_xyz, lab);
    if (result.log_deviation)
        score.values[key::kDeviation] = one(*result.log_deviation / std::log(2.0));
    return score;
}

} // namespace srisp::tool
