// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "train/evaluation/measure.h"

namespace srisp::train {

/// The crops of one test set in one rendering, all or those of one camera: a method beside gain match, and both given
/// the truth's brightness. [method 5]
struct ScoreGroup {
    std::string set;       ///< "real", "simulated", "developed"
    std::string rendering; ///< how the photos were made of the RAW: "random", "fixed", "camera", or a converter
    std::string camera;    ///< empty: all cameras of the set
    int cameras = 1;
    Measure gain_match;
    Measure gain_match_oracle; ///< gain match, given the truth's channel means in place of the reference's
    Measure model;
    Measure model_oracle;      ///< the results times one gain per channel, so that their means are the truth's
    Measure model_oracle_gain; ///< the results times one gain per image

    double psnr_gain() const;   ///< dB over gain match
    double angle_ratio() const; ///< angle over gain match's
    double covered() const;     ///< part of the distance in dB from gain match to gain match with the truth's means
};

/// Photos of other people, each with several references: no truth, so the results are held against the references.
struct UnpairedScores {
    struct Method {
        double intersection = 0; ///< of Lab histograms, all results against all references
        /// Rank correlation over the references of the log channel means of results and references, per photo: mean and
        /// lowest over the photos.
        std::array<double, 3> rank_mean{}, rank_lowest{};
    };
    int photos = 0, references = 0;
    Method gain_match, model;
};

/// What `evaluate` found out about one method.
struct Scores {
    std::vector<ScoreGroup> groups; ///< the whole sets first, then by camera
    std::optional<UnpairedScores> unpaired;

    /// The whole set in this rendering; null where it was not evaluated.
    const ScoreGroup* find(const std::string& set, const std::string& rendering) const;
};

/// Scores of several methods on the same evaluation set, by name.
using NamedScores = std::vector<std::pair<std::string, Scores>>;

/// A table for people: each set and rendering with gain match first; lines per camera if `by_camera`.
std::string score_table(const NamedScores& scores, bool by_camera);

nlohmann::ordered_json score_json(const Scores& scores);

} // namespace srisp::train
