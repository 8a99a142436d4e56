// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

namespace srisp::train {

constexpr char kCsvLog[] = "log.csv", kJsonLog[] = "log.jsonl";

/// A training's log in its output folder: `log.csv` with the numbers that are drawn, `log.jsonl` with everything, one
/// line per entry, each on disk at once.
class RunLog {
public:
    explicit RunLog(const std::string& folder);

    /// Forgets what was logged after `step`: a training that resumes does these steps again.
    Status resume_after(std::int64_t step);

    /// `entry` has a "step"; the numbers in it that log.csv has columns for go there.
    Status add(const nlohmann::ordered_json& entry);

private:
    std::string m_csv_path, m_json_path;
};

} // namespace srisp::train
