// SPDX-License-Identifier: Apache-2.0
#include "validation.h"

namespace srisp::train {

Validation validation_of(const Scores& scores, const std::string& score)
{
    const auto counts = [&score](const ScoreGroup& group) {
        return group.camera.empty() && (score == "all" || group.set == score);
    };
    Validation result;
    int groups = 0;
    for (const ScoreGroup& group : scores.groups)
        if (counts(group)) {
            result.psnr += group.model.psnr();
            result.angle += group.model.angle.mean();
            ++groups;
        }
    if (groups == 0 && score != "all")
        return validation_of(scores, "all");
    result.psnr /= groups;
    result.angle /= groups;
    result.score = result.psnr - result.angle;
    result.details = score_json(scores);
    return result;
}

} // namespace srisp::train
