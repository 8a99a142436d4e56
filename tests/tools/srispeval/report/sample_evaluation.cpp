// SPDX-License-Identifier: Apache-2.0
#include "sample_evaluation.h"

#include <cmath>
#include <random>

#include "../../../../tools/srispeval/metric_table.h"

using namespace srisp::tool;

namespace {

const std::vector<std::string> kMethods{ "gain_match", "default", "metadata", "cpp <b>bold</b>" };
const std::vector<std::string> kCameras{ "Nikon D7200", "Canon EOS 5D Mark IV", "Sony ILCE-7M3", kHostileCamera };

const char kParameters[] = R"({"format": "srisp-parameters-1", "gain": 0.412345678, "brightness_sd_ev": 0.21,
"white_balance": [1.98765432, 1, 1.51234567], "color": [[1.6, -0.5, -0.1], [-0.2, 1.5, -0.3], [0.02, -0.4, 1.38]],
"gamma": 1.1, "weights": {"tone": [[0.7, 0.2, 0.1, 0], [0.1, 0.1, 0.8, 0], [0, 0, 0, 1], [0.25, 0.25, 0.25, 0.25]],
"gamma": [0.5, 0.5], "color": [0.9, 0.1], "white_balance": [0.004, 0.996], "gain": [1]},
"model": {"name": "default", "hash": "</pre><script>alert(2)</script>"}})";

/// Random numbers that are the same on every machine.
class Dice {
public:
    double normal(double mean, double deviation)
    {
        double sum = -6;
        for (int i = 0; i < 12; ++i)
            sum += double(m_engine()) / 4294967296.0;
        return mean + deviation * sum;
    }

private:
    std::mt19937 m_engine{ 7 };
};

std::string file_name(int i)
{
    if (i == 1)
        return kHostileName;
    if (i == 3)
        return kInvalidName;
    return "shoot" + std::to_string(i % 5) + "/_DSC" + std::to_string(1000 + i * 37) + ".dng";
}

MethodScore score_of(Dice& dice, std::size_t method, bool has_truth)
{
    const double skill = method == 0 ? 0 : method == 1 ? 1 : method == 2 ? 0.9 : 0.03;
    const auto one = [](double value) { return Measured{ value, 1 }; };
    MethodScore score;
    score.values[key::kLab] = one(dice.normal(0.5 + 0.2 * skill, 0.05));
    if (!has_truth) {
        for (const char* key : { key::kRankRed, key::kRankGreen, key::kRankBlue })
            score.values[key] = one(dice.normal(0.7 + 0.2 * skill, 0.05));
        return score;
    }
    score.values[key::kPsnr] = one(dice.normal(26 + 6 * skill, 3));
    score.values[key::kSsim] = one(dice.normal(0.9 + 0.05 * skill, 0.02));
    score.values[key::kAngle] = one(std::abs(dice.normal(4 - 2.3 * skill, 1)));
    score.values[key::kDeltaE] = one(std::abs(dice.normal(8 - 4 * skill, 2)));
    score.values[key::kBrightness] = one(dice.normal(0.02, 0.4 - 0.25 * skill));
    if (dice.normal(0, 1) > -0.5)
        score.values[key::kHighlights] = { dice.normal(-0.05, 0.05) * 100, 100 };
    score.values[key::kHighlightsAtGain] = { 0, 0 };
    score.values[key::kEdits] = one(dice.normal(24 + 4 * skill, 2));
    score.values[key::kPsnrAtGain] = one(dice.normal(31 + 3 * skill, 2));
    if (method == 1) {
        score.values[key::kDeviation] = one(std::abs(dice.normal(0.3, 0.05)));
        score.values[key::kWithinOne] = one(0.66);
    }
    return score;
}

Interval around(double mean, double half)
{
    return { mean, mean - half, mean + half };
}

/// Means with made-up intervals.
MethodSummary summary_of(const std::vector<const ImageScore*>& images, std::size_t index, bool has_truth)
{
    MethodSummary summary;
    summary.method = kMethods[index];
    for (const Metric& metric : metrics()) {
        Measured sum, difference;
        for (const ImageScore* image : images) {
            const auto& values = image->methods.at(kMethods[index]).values;
            const auto& base = image->methods.at(kMethods[0]).values;
            if (!values.count(metric.key) || !(values.at(metric.key).weight > 0))
                continue;
            sum.sum += values.at(metric.key).value();
            sum.weight += 1;
            if (!base.count(metric.key) || !(base.at(metric.key).weight > 0))
                continue;
            difference.sum += values.at(metric.key).value() - base.at(metric.key).value();
            difference.weight += 1;
        }
        if (sum.weight > 0)
            summary.values[metric.key] = around(sum.value(), std::abs(sum.value()) * 0.02);
        if (index > 0 && difference.weight > 0)
            summary.over_baseline[metric.key] = around(difference.value(), std::abs(sum.value()) * 0.02);
    }
    if (!has_truth) {
        summary.brightness_spread = around(NAN, NAN);
        summary.error_by_level.fill(around(NAN, NAN));
        return summary;
    }
    summary.brightness_spread = around(index == 0 ? 0.41 : 0.17, 0.03);
    for (int level = 0; level < kLevels; ++level)
        summary.error_by_level[std::size_t(level)] =
            around((double(index) - 1.2) * 0.01 * (level - 2), 0.002 + 0.0008 * level * level);
    if (index == 1)
        for (const double z : kCoverage)
            summary.coverage.push_back(std::erf(z * 0.85 / std::sqrt(2.0)));
    return summary;
}

GroupSummary group_of(const Evaluation& evaluation, const std::string& rendering, const std::string& camera)
{
    std::vector<const ImageScore*> images;
    for (const ImageScore& image : evaluation.images)
        if (image.rendering == rendering && (camera.empty() || image.camera == camera))
            images.push_back(&image);
    GroupSummary group{ rendering, camera, int(images.size()), int(images.size()), camera.empty() ? 4 : 1, {} };
    for (std::size_t i = 0; i < kMethods.size(); ++i)
        group.methods.push_back(summary_of(images, i, evaluation.has_truth));
    return group;
}

} // namespace

Evaluation sample_evaluation(bool has_truth, int count)
{
    Dice dice;
    Evaluation evaluation;
    evaluation.protocol = has_truth ? "half-split" : "unpaired";
    evaluation.settings = { { "model", "default" }, { "folder", kInvalidName }, { "seed", "1" } };
    evaluation.protocol_text = { "Each RAW file is cut in two halves; one is the reference, the other is rendered, "
                                 "unprocessed again and held against what it was.",
                                 "Means are over images; intervals are from 1000 resamplings of files." };
    evaluation.version = "0.9.0";
    evaluation.methods = kMethods;
    evaluation.has_truth = has_truth;
    evaluation.complete = has_truth;
    evaluation.left_out = { { kHostileName, "cannot be read: <img src=x onerror=alert(3)>" },
                            { "b.dng", "too small" } };
    const std::vector<std::string> renderings =
        has_truth ? std::vector<std::string>{ "fixed", "random" } : std::vector<std::string>{ "photo" };
    for (int i = 0; i < count; ++i) {
        ImageScore image;
        image.image = file_name(i);
        image.part = has_truth ? (i % 2 ? "bottom" : "top") : "";
        image.rendering = renderings[std::size_t(i) % renderings.size()];
        image.camera = kCameras[std::size_t(i / 2) % kCameras.size()];
        image.reference = "left half";
        image.width = 1500;
        image.height = 1000;
        image.reference_chromaticity = { dice.normal(-0.6, 0.15), dice.normal(-0.5, 0.15) };
        if (has_truth)
            image.truth_chromaticity = { dice.normal(-0.6, 0.2), dice.normal(-0.5, 0.2) };
        for (std::size_t method = 0; method < kMethods.size(); ++method) {
            MethodScore score = score_of(dice, method, has_truth);
            const Chromaticity near = has_truth ? *image.truth_chromaticity : *image.reference_chromaticity;
            score.chromaticity = { near[0] + dice.normal(0, 0.05), near[1] + dice.normal(0, 0.05) };
            if (method > 0)
                score.parameters = method == 3 ? "not JSON </pre>" : kParameters;
            if (method == 0 && i % 9 == 4)
                score.values[key::kBrightness] = { 0, 0 };
            image.methods[kMethods[method]] = score;
        }
        if (i % 7 == 1)
            image.notes = { "14 % of the photo is clipped <u>", "no \"edits\"" };
        evaluation.images.push_back(image);
    }
    for (const std::string& rendering : renderings) {
        evaluation.groups.push_back(group_of(evaluation, rendering, ""));
        for (const std::string& camera : kCameras)
            evaluation.groups.push_back(group_of(evaluation, rendering, camera));
    }
    return evaluation;
}
