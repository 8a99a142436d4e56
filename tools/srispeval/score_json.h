// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

#include "scores.h"

// Scores as JSON. Numbers without a value are null.

namespace srisp::tool {

/// JSON has no NaN and no infinity: null.
nlohmann::ordered_json json_number(double value);

/// What such a file says of its format.
constexpr char kScoresFormat[] = "srisp-scores-1";

nlohmann::ordered_json to_json(const ImageScore& image);
/// Error: what is missing or of a wrong type, without where.
Expected<ImageScore> image_score_from_json(const nlohmann::json& json);

/// Everything; `indent` < 0: on one line.
std::string to_json(const Evaluation& evaluation, int indent = 1);

/// What `compare` needs of such a file: methods and images. Errors: `'a.json': reason`.
Expected<Evaluation> read_evaluation(const std::string& path);

} // namespace srisp::tool
