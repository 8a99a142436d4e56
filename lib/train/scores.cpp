// SPDX-License-Identifier: Apache-2.0
#include "scores.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace srisp::train {

using Json = nlohmann::ordered_json;

double ScoreGroup::psnr_gain() const
{
    return model.psnr() - gain_match.psnr();
}

double ScoreGroup::angle_ratio() const
{
    return model.angle.mean() / gain_match.angle.mean();
}

double ScoreGroup::covered() const
{
    return psnr_gain() / (gain_match_oracle.psnr() - gain_match.psnr());
}

const ScoreGroup* Scores::find(const std::string& set, const std::string& rendering) const
{
    for (const ScoreGroup& group : groups)
        if (group.set == set && group.rendering == rendering && group.camera.empty())
            return &group;
    return nullptr;
}

namespace {

/// JSON has no NaN and no infinity: what has no value is null.
Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json(const Measure& m)
{
    return { { "psnr_db", number(m.psnr()) },
             { "angle_degrees", number(m.angle.mean()) },
             { "skipped_pixels", m.angle.skipped },
             { "log_mean_error", number(m.log_error_mean()) },
             { "log_mean_error_deviation", number(m.log_error_deviation()) },
             { "highlight_error", number(m.highlights.mean()) },
             { "highlight_error_at_gain", number(m.highlights.mean_at_gain()) },
             { "highlight_values", m.highlights.values } };
}

Json json(const ScoreGroup& group)
{
    return { { "set", group.set },
             { "rendering", group.rendering },
             { "camera", group.camera.empty() ? Json(nullptr) : Json(group.camera) },
             { "cameras", group.cameras },
             { "crops", group.model.crops },
             { "psnr_over_gain_match_db", number(group.psnr_gain()) },
             { "angle_ratio", number(group.angle_ratio()) },
             { "covered", number(group.covered()) },
             { "gain_match", json(group.gain_match) },
             { "gain_match_with_true_means", json(group.gain_match_oracle) },
             { "model", json(group.model) },
             { "model_with_true_means", json(group.model_oracle) },
             { "model_with_true_gain", json(group.model_oracle_gain) } };
}

Json json(const UnpairedScores::Method& method)
{
    Json rank_mean = Json::array(), rank_lowest = Json::array();
    for (int c = 0; c < 3; ++c) {
        rank_mean.push_back(number(method.rank_mean[c]));
        rank_lowest.push_back(number(method.rank_lowest[c]));
    }
    return { { "histogram_intersection", number(method.intersection) },
             { "rank_correlation_mean", rank_mean },
             { "rank_correlation_lowest", rank_lowest } };
}

} // namespace

Json score_json(const Scores& scores)
{
    Json groups = Json::array();
    for (const ScoreGroup& group : scores.groups)
        groups.push_back(json(group));
    Json result{ { "groups", groups } };
    if (scores.unpaired)
        result["unpaired"] = { { "photos", scores.unpaired->photos },
                               { "references", scores.unpaired->references },
                               { "gain_match", json(scores.unpaired->gain_match) },
                               { "model", json(scores.unpaired->model) } };
    return result;
}

} // namespace srisp::train
