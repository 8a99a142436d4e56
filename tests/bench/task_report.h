// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "task_network.h"

/// What one network reached.
struct TaskResult {
    std::string settings; ///< all that another run must share to be compared with this one
    std::string target;   ///< camera and light
    TaskAnswers answers;
};

/// One file in a folder for each seed and method, so that a run that was stopped goes on. Throws std::runtime_error.
std::string result_path(const std::string& folder, int seed, const std::string& method);
void write_result(const std::string& path, const TaskResult& result);
/// Nothing where there is no file.
std::optional<TaskResult> read_result(const std::string& path);

/// Of all seeds, by method; each method has the same seeds in the same order.
using TaskResults = std::vector<std::pair<std::string, std::vector<TaskResult>>>;

/// A mean over seeds with what it may be off by, in percentage points.
struct MeanWithInterval {
    double mean = 0;
    double seeds = 0;                       ///< half of the 95 % interval over seeds: Student's t
    double photos_low = 0, photos_high = 0; ///< the 95 % interval over test photos: bootstrap
    std::vector<double> by_seed;
};

/// Of the right answers of one kind, or of their difference to those of `base`.
MeanWithInterval mean_of(const std::vector<TaskResult>& results, const std::vector<TaskResult>* base,
                         Answers TaskAnswers::*kind);

std::string report_text(const TaskResults& results, const std::string& base);
nlohmann::ordered_json report_json(const TaskResults& results, const std::string& base);
