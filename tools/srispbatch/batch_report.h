// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "base/progress.h"

namespace srisp::tool {

/// What became of a set.
struct BatchSummary {
    std::int64_t planned = 0, made = 0, done_before = 0, failed = 0, copied = 0;
    double seconds = 0, megapixels = 0;
    std::map<std::string, std::int64_t> reasons; ///< of failures: the first words of their messages
    std::string failed_path;                     ///< where they are listed; empty: there are none
};

/// What a dry run found out.
struct BatchForecast {
    BatchSummary summary;
    std::int64_t photos = 0; ///< of all shards
    int sampled = 0;         ///< results that were made to measure, and thrown away
    double seconds = 0;      ///< of the whole run
    double bytes = 0;
    std::int64_t shards = 0, photos_per_shard = 0; ///< 0: not asked for
};

/// Tells people, or with --json programs, how far a run has come. Not for several threads at a time.
class BatchReport {
public:
    BatchReport(bool json, bool quiet);

    void started(const BatchSummary& summary);
    void made(const BatchSummary& summary);
    /// `failure`: a line of failed.jsonl.
    void failed(const BatchSummary& summary, const nlohmann::ordered_json& failure);
    void finished(const BatchSummary& summary);
    void forecast(const BatchForecast& forecast);

private:
    using Clock = std::chrono::steady_clock;

    void event(const char* kind, const nlohmann::ordered_json& content);
    void show(const BatchSummary& summary);

    const bool m_json, m_quiet;
    ProgressLine m_line;
    Clock::time_point m_start, m_last_event;
};

} // namespace srisp::tool
