// SPDX-License-Identifier: Apache-2.0
#include "validation.h"

#include <cmath>

namespace srisp::train {

namespace {

// What weighs as much as one dB: one degree, or a tenth of full scale in the highlights.
constexpr double kHighlightWeight = 10;

/// Nothing where no pixel was bright enough to count.
double highlight_error(const Measure& measure)
{
    const double error = std::abs(measure.highlights.mean_at_gain());
    return std::isfinite(error) ? error : 0;
}

} // namespace

Validation validation_of(const Scores& scores, const std::string& score)
{
    const auto counts = [&score](const ScoreGroup& group) {
        return group.camera.empty() && (score == "all" || group.set == score);
    };
    Validation result;
    double highlights = 0;
    int groups = 0;
    for (const ScoreGroup& group : scores.groups)
        if (counts(group)) {
            result.psnr += group.model.psnr();
            result.angle += group.model.angle.mean();
            highlights += highlight_error(group.model);
            ++groups;
        }
    if (groups == 0 && score != "all")
        return validation_of(scores, "all");
    result.psnr /= groups;
    result.angle /= groups;
    result.score = result.psnr - result.angle - kHighlightWeight * highlights / groups;
    result.details = score_json(scores);
    return result;
}

} // namespace srisp::train
