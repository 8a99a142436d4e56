// SPDX-License-Identifier: Apache-2.0
#include "batch_report.h"

#include <algorithm>
#include <cstdio>

#include "base/printed.h"

namespace srisp::tool {

namespace {

using nlohmann::ordered_json;

/// "3.4 GB"
std::string size_text(double bytes)
{
    static const char* const kUnits[] = { "kB", "MB", "GB", "TB", "PB" };
    std::size_t unit = 0;
    bytes /= 1e3;
    for (; bytes >= 1000 && unit + 1 < std::size(kUnits); ++unit)
        bytes /= 1e3;
    return printed("%.*f %s", bytes < 10 ? 1 : 0, bytes, kUnits[unit]);
}

std::string rate_text(const BatchSummary& summary, double seconds)
{
    return printed("%.1f a second, %.1f Mpx/s", double(summary.made) / seconds, summary.megapixels / seconds);
}

std::string summary_text(const BatchSummary& summary)
{
    std::string text = std::to_string(summary.planned) + " results: " + std::to_string(summary.made) + " made, " +
                       std::to_string(summary.done_before) + " done before, " + std::to_string(summary.failed) +
                       " failed";
    if (summary.copied)
        text += "; " + std::to_string(summary.copied) + " other files copied";
    if (summary.made && summary.seconds > 0)
        text += "; " + rate_text(summary, summary.seconds);
    text += "\n";
    for (const auto& [reason, count] : summary.reasons)
        text += "  " + std::to_string(count) + " × " + reason + "\n";
    if (!summary.failed_path.empty())
        text += "  listed in " + summary.failed_path + "; the same command tries them again\n";
    return text;
}

ordered_json counts(const BatchSummary& summary)
{
    return { { "results", summary.planned }, { "made", summary.made },     { "done_before", summary.done_before },
             { "failed", summary.failed },   { "copied", summary.copied }, { "megapixels", summary.megapixels } };
}

} // namespace

BatchReport::BatchReport(bool json, bool quiet)
    : m_json(json), m_quiet(quiet), m_line(!quiet && !json), m_start(Clock::now()), m_last_event(m_start)
{
}

void BatchReport::event(const char* kind, const ordered_json& content)
{
    ordered_json line = { { "event", kind } };
    line.update(content);
    std::fputs((line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n").c_str(), stdout);
    std::fflush(stdout);
}

void BatchReport::started(const BatchSummary& summary)
{
    m_start = Clock::now();
    if (m_json)
        event("started", counts(summary));
}

void BatchReport::made(const BatchSummary& summary)
{
    show(summary);
}

void BatchReport::failed(const BatchSummary& summary, const ordered_json& failure)
{
    if (m_json) {
        event("failed", failure);
    } else {
        m_line.wipe();
        std::fprintf(stderr, "srispbatch: %s\n", failure["error"].get<std::string>().c_str());
    }
    show(summary);
}

void BatchReport::show(const BatchSummary& summary)
{
    const std::int64_t now = summary.done_before + summary.made + summary.failed;
    const double seconds = std::chrono::duration<double>(Clock::now() - m_start).count();
    if (m_json && Clock::now() - m_last_event >= std::chrono::seconds(1)) {
        m_last_event = Clock::now();
        ordered_json content = counts(summary);
        content["seconds"] = seconds;
        event("progress", content);
    }
    m_line.show([&] {
        const WorkCount count{ "srispbatch", "images", summary.planned, summary.done_before };
        return count.text(now, seconds) + printed(", %.1f Mpx/s", summary.megapixels / seconds) +
               (summary.failed ? ", " + std::to_string(summary.failed) + " failed" : "");
    });
}

void BatchReport::finished(const BatchSummary& summary)
{
    m_line.wipe();
    if (m_json) {
        ordered_json content = counts(summary);
        content["seconds"] = summary.seconds;
        content["reasons"] = summary.reasons;
        content["failed_list"] = summary.failed_path;
        event("finished", content);
    } else if (!m_quiet) {
        std::fputs(summary_text(summary).c_str(), stdout);
    }
}

void BatchReport::forecast(const BatchForecast& forecast)
{
    const BatchSummary& summary = forecast.summary;
    m_line.wipe();
    if (m_json) {
        ordered_json content = counts(summary);
        content.update({ { "photos", forecast.photos },
                         { "sampled", forecast.sampled },
                         { "seconds", forecast.seconds },
                         { "bytes", forecast.bytes },
                         { "shards", forecast.shards } });
        event("forecast", content);
        return;
    }
    if (m_quiet)
        return;
    std::string text = std::to_string(summary.planned) + " results, of which " + std::to_string(summary.done_before) +
                       " are done; nothing was made\n";
    if (forecast.sampled)
        text += "  about " + duration_text(forecast.seconds) + " and " + size_text(forecast.bytes) + ", by " +
                std::to_string(forecast.sampled) + " of them\n";
    if (forecast.shards)
        text += "  " + std::to_string(forecast.shards) + " shards of about " +
                std::to_string(forecast.photos_per_shard) + " photos: sbatch --array=0-" +
                std::to_string(forecast.shards - 1) + "\n";
    for (const auto& [reason, count] : summary.reasons)
        text += "  " + std::to_string(count) + " of these failed: " + reason + "\n";
    std::fputs(text.c_str(), stdout);
}

} // namespace srisp::tool
