// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/evaluation.h"

#include <algorithm>
#include <cmath>

#include "train/baselines/baselines.h"
#include "train/evaluation/developed_images.h"
#include "train/evaluation/measure.h"
#include "train/evaluation/test_scenes.h"
#include "train/evaluation/unpaired_evaluation.h"
#include "train/network/unprocessor.h"

namespace srisp::train {

namespace {

/// Half split crops of one set in one rendering.
struct TestCrops {
    torch::Tensor source, truth, reference;
    std::vector<int> camera;           ///< of each crop
    std::vector<ScoreGroup> by_camera; ///< gain match is measured, the model is not
};

/// Adds what `result` says of each crop to the measure of its camera.
void measure(const TestCrops& crops, const torch::Tensor& result, Measure ScoreGroup::*member,
             std::vector<ScoreGroup>& by_camera, const torch::Tensor& log_deviations = {})
{
    const InterleavedImages results(result), truths(crops.truth);
    for (std::size_t i = 0; i < crops.camera.size(); ++i) {
        std::optional<double> log_deviation;
        if (log_deviations.defined())
            log_deviation = log_deviations[static_cast<std::int64_t>(i)].item<double>();
        (by_camera[crops.camera[i]].*member).add(results[i], truths[i], log_deviation);
    }
}

/// Images times one gain each, or each channel, that gives them the truth's mean.
torch::Tensor with_true_means(const torch::Tensor& result, const torch::Tensor& truth, bool per_channel)
{
    const std::vector<std::int64_t> over =
        per_channel ? std::vector<std::int64_t>{ 2, 3 } : std::vector<std::int64_t>{ 1, 2, 3 };
    const auto gain = truth.mean(over, true) / result.mean(over, true).clamp_min(1e-6);
    return (result * gain).clamp(0, 1);
}

TestCrops half_split(const TestScenes& scenes, const torch::Tensor& photos, const std::string& rendering,
                     Unprocessor& gain_match, int thumbnail_px)
{
    TestCrops crops;
    crops.source = right_quarters(photos);
    crops.truth = right_quarters(scenes.raw);
    crops.reference = left_halves(scenes.raw).repeat_interleave(2, 0);
    for (const int camera : scenes.camera)
        crops.camera.insert(crops.camera.end(), 2, camera);
    for (const std::string& name : scenes.cameras) {
        ScoreGroup group;
        group.set = scenes.set;
        group.rendering = rendering;
        group.camera = name;
        crops.by_camera.push_back(group);
    }
    measure(crops, batched_reverse(gain_match, crops.source, crops.reference, thumbnail_px), &ScoreGroup::gain_match,
            crops.by_camera);
    measure(crops, batched_reverse(gain_match, crops.source, crops.truth, 0), &ScoreGroup::gain_match_oracle,
            crops.by_camera);
    return crops;
}

/// All cameras of a set as one group.
ScoreGroup total(const std::vector<ScoreGroup>& by_camera)
{
    ScoreGroup result = by_camera.front();
    result.camera.clear();
    result.cameras = static_cast<int>(by_camera.size());
    for (std::size_t i = 1; i < by_camera.size(); ++i)
        for (const auto member : { &ScoreGroup::gain_match, &ScoreGroup::gain_match_oracle, &ScoreGroup::model,
                                   &ScoreGroup::model_oracle, &ScoreGroup::model_oracle_gain })
            result.*member += by_camera[i].*member;
    return result;
}

// What weighs as much as one dB: one degree, or a tenth of full scale in the highlights.
constexpr double kHighlightWeight = 10;

/// Nothing where no pixel was bright enough to count.
double highlight_error(const Measure& measure)
{
    const double error = std::abs(measure.highlights.mean_at_gain());
    return std::isfinite(error) ? error : 0;
}

} // namespace

struct EvaluationSet::State {
    EvaluationSettings settings;
    std::vector<TestCrops> crops;
    std::optional<UnpairedImages> unpaired;
};

Expected<std::shared_ptr<const EvaluationSet>> EvaluationSet::make(const EvaluationSettings& settings,
                                                                   const TrainingPack& pack)
{
    GainMatch gain_match;
    auto state = std::make_unique<State>();
    state->settings = settings;
    const torch::Tensor matrices = test_matrices(pack, settings.seed);
    const auto add = [&](const TestScenes& scenes, const torch::Tensor& photos, const std::string& rendering) {
        state->crops.push_back(half_split(scenes, photos, rendering, gain_match, settings.thumbnail_px));
    };
    const std::vector<TestScenes> sets{ real_test_scenes(settings, pack.raws(), TestExposure::wide),
                                        simulated_test_scenes(settings, pack, TestExposure::wide) };
    const std::vector<TestScenes> camera_sets{ real_test_scenes(settings, pack.raws(), TestExposure::camera),
                                               simulated_test_scenes(settings, pack, TestExposure::camera) };
    for (std::size_t i = 0; i < sets.size(); ++i) {
        if (sets[i].camera.empty())
            continue;
        add(sets[i], random_rendering(sets[i], matrices, settings.seed), "random");
        add(sets[i], fixed_rendering(sets[i], matrices), "fixed");
        add(camera_sets[i], camera_rendering(camera_sets[i], matrices, settings.seed), "camera");
    }
    if (!settings.developed.empty()) {
        const Expected<DevelopedImages> developed = read_developed_images(settings.developed);
        if (!developed)
            return developed.error();
        for (const auto& [converter, photos] : developed->photos)
            add(developed->scenes, photos, converter);
    }
    if (state->crops.empty())
        return Error{ "evaluation: the pack has neither real RAW images nor photos and cameras marked for validation" };
    state->unpaired = make_unpaired_images(settings, pack.photos(), sets, matrices, gain_match);
    return std::shared_ptr<const EvaluationSet>(new EvaluationSet(std::move(state)));
}

EvaluationSet::EvaluationSet(std::unique_ptr<const State> state) : m_state(std::move(state)) {}

EvaluationSet::~EvaluationSet() = default;

int EvaluationSet::crops() const
{
    std::size_t count = 0;
    for (const TestCrops& crops : m_state->crops)
        count += crops.camera.size();
    return static_cast<int>(count);
}

Scores evaluate(Unprocessor& method, const EvaluationSet& set, const std::function<void(int)>& progress)
{
    const bool was_training = method.is_training();
    method.eval();
    Scores scores;
    std::vector<ScoreGroup> cameras;
    int done = 0;
    for (const TestCrops& crops : set.m_state->crops) {
        std::vector<ScoreGroup> groups = crops.by_camera;
        torch::Tensor log_deviations;
        const auto result =
            batched_reverse(method, crops.source, crops.reference, set.m_state->settings.thumbnail_px, &log_deviations);
        measure(crops, result, &ScoreGroup::model, groups, log_deviations);
        measure(crops, with_true_means(result, crops.truth, true), &ScoreGroup::model_oracle, groups);
        measure(crops, with_true_means(result, crops.truth, false), &ScoreGroup::model_oracle_gain, groups);
        scores.groups.push_back(total(groups));
        cameras.insert(cameras.end(), groups.begin(), groups.end());
        if (progress)
            progress(done += static_cast<int>(crops.camera.size()));
    }
    scores.groups.insert(scores.groups.end(), cameras.begin(), cameras.end());
    if (set.m_state->unpaired)
        scores.unpaired = evaluate_unpaired(method, *set.m_state->unpaired, set.m_state->settings.thumbnail_px);
    method.train(was_training);
    return scores;
}

Validation validation_of(const Scores& scores, const std::string& score)
{
    const auto counts = [&score](const ScoreGroup& group) {
        return group.camera.empty() && (score == "all" || group.set == score);
    };
    Validation result;
    double highlights = 0, log_factor = 0;
    int groups = 0;
    for (const ScoreGroup& group : scores.groups)
        if (counts(group)) {
            result.psnr += group.model.psnr();
            result.angle += group.model.angle.mean();
            highlights += highlight_error(group.model);
            log_factor += std::log(group.model.deviation_factor());
            ++groups;
        }
    if (groups == 0 && score != "all")
        return validation_of(scores, "all");
    result.psnr /= groups;
    result.angle /= groups;
    result.score = result.psnr - result.angle - kHighlightWeight * highlights / groups;
    if (std::isfinite(log_factor))
        result.deviation_factor = std::exp(log_factor / groups);
    result.details = score_json(scores);
    return result;
}

} // namespace srisp::train
