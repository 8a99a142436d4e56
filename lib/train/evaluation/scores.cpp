// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/scores.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/printed.h"

namespace srisp::train {

namespace {

/// The columns, in the widths of `line`.
std::string header()
{
    return printed("%-22s %6s  %9s  %8s  %6s  %5s  %16s  %10s  %8s  %7s\n", "", "dB", "over g.m.", "covered", "angle",
                   "ratio", "ln mean error", "highlights", "at gain", "skipped");
}

/// A line of the table; `relation` stands in the columns "over g.m." and "covered", and `ratio` in its own.
std::string line(const std::string& name, const Measure& m, const std::string& relation = "",
                 const std::string& ratio = "")
{
    return printed("%-22.22s %6.2f  %19s  %6.2f  %5s  %+7.3f +- %.3f  %+10.3f  %+8.3f  %7lld\n", name.c_str(), m.psnr(),
                   relation.c_str(), m.angle.mean(), ratio.c_str(), m.log_error_mean(), m.log_error_deviation(),
                   m.highlights.mean(), m.highlights.mean_at_gain(), static_cast<long long>(m.angle.skipped));
}

/// How sure the model is of the brightness, and whether rightly; empty where it does not tell.
std::string deviation_line(const Measure& m)
{
    if (m.deviations.empty())
        return "";
    return printed("%-22.22s %.2f EV on average, %.0f %% of the errors within one, %.0f %% within two\n",
                   "  standard deviation", m.mean_deviation_ev(), 100 * m.share_within(1), 100 * m.share_within(2));
}

std::string model_lines(const std::string& name, const ScoreGroup& group)
{
    return line(name, group.model, printed("%+9.2f  %6.0f %%", group.psnr_gain(), 100 * group.covered()),
                printed("%.2f", group.angle_ratio())) +
           line("  + true means", group.model_oracle) + line("  + true gain", group.model_oracle_gain) +
           deviation_line(group.model);
}

std::string group_title(const ScoreGroup& group)
{
    const std::string where = group.camera.empty() ? printed("%d cameras", group.cameras) : group.camera;
    const bool developed = group.set == "developed";
    const char* const set = developed ? "real RAW by " : group.set == "real" ? "real RAW, " : "simulated RAW, ";
    return printed("%s%s%s: %d crops of %s\n", set, group.rendering.c_str(), developed ? "" : " rendering",
                   group.model.crops, where.c_str());
}

std::string group_table(const NamedScores& scores, std::size_t index)
{
    const ScoreGroup& first = scores.front().second.groups[index];
    std::string result = group_title(first) + header() + line("gain match", first.gain_match) +
                         line("  + true means", first.gain_match_oracle);
    for (const auto& [name, of_model] : scores)
        result += model_lines(name, of_model.groups[index]);
    return result + "\n";
}

/// One short line per camera and method.
std::string camera_lines(const NamedScores& scores)
{
    std::string result =
        "by camera                                                dB  over g.m.  covered  angle  ratio\n";
    for (std::size_t i = 0; i < scores.front().second.groups.size(); ++i)
        for (const auto& [name, of_model] : scores) {
            const ScoreGroup& group = of_model.groups[i];
            if (!group.camera.empty())
                result +=
                    printed("%-28.28s %-7.7s %-14.14s %7.2f  %+8.2f  %5.0f %%  %5.2f  %5.2f\n", group.camera.c_str(),
                            group.rendering.c_str(), name.c_str(), group.model.psnr(), group.psnr_gain(),
                            100 * group.covered(), group.model.angle.mean(), group.angle_ratio());
        }
    return result + "\n";
}

std::string unpaired_line(const std::string& name, const UnpairedScores::Method& method)
{
    const auto& mean = method.rank_mean;
    const auto& lowest = method.rank_lowest;
    return printed("%-22.22s        %.3f       %5.2f %5.2f %5.2f        %5.2f %5.2f %5.2f\n", name.c_str(),
                   method.intersection, mean[0], mean[1], mean[2], lowest[0], lowest[1], lowest[2]);
}

std::string unpaired_table(const NamedScores& scores)
{
    const UnpairedScores& first = *scores.front().second.unpaired;
    std::string result =
        printed("%d photos, each with the same %d references, unpaired\n", first.photos, first.references);
    result += "                        histogram    rank correlation per channel, of a photo's brightness\n"
              "                     intersection    mean over photos         lowest\n";
    result += unpaired_line("gain match", first.gain_match);
    for (const auto& [name, of_model] : scores)
        result += unpaired_line(name, of_model.unpaired->model);
    return result + "\n";
}

} // namespace

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
             { "deviation_ev", number(m.mean_deviation_ev()) },
             { "within_one_deviation", number(m.share_within(1)) },
             { "within_two_deviations", number(m.share_within(2)) },
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

std::string score_table(const NamedScores& scores, bool by_camera)
{
    if (scores.empty())
        return "";
    std::string result;
    const Scores& first = scores.front().second;
    for (std::size_t i = 0; i < first.groups.size(); ++i)
        if (first.groups[i].camera.empty())
            result += group_table(scores, i);
    if (by_camera)
        result += camera_lines(scores);
    if (first.unpaired)
        result += unpaired_table(scores);
    return result;
}

} // namespace srisp::train
