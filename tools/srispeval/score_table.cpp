// SPDX-License-Identifier: Apache-2.0
#include "score_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/printed.h"
#include "base/shown_text.h"
#include "metric_table.h"
#include "score_words.h"

namespace srisp::tool {

namespace {

std::string number(double value, int digits)
{
    return std::isfinite(value) ? printed("%.*f", digits, value) : "-";
}

/// "35.20 (34.1 to 36.3)"
std::string with_interval(const Interval& value, int digits, const char* sign = "")
{
    std::string result =
        std::isfinite(value.mean) ? printed("%s%.*f", value.mean >= 0 ? sign : "", digits, value.mean) : "-";
    if (std::isfinite(value.low))
        result += " (" + number(value.low, digits) + " to " + number(value.high, digits) + ")";
    return result;
}

std::string group_title(const Evaluation& evaluation, const GroupSummary& group)
{
    const bool photos = !evaluation.has_truth;
    std::string title = photos ? "photos with references" : "rendering " + shown_text(group.rendering);
    if (!group.camera.empty())
        title += ", " + shown_text(group.camera);
    return title + ": " + counted(group.images, "image") + " of " + counted(group.files, "file") + ", " +
           counted(group.cameras, "camera") + "\n";
}

std::string group_table(const Evaluation& evaluation, const GroupSummary& group)
{
    std::string result = group_title(evaluation, group);
    std::size_t widest = 0;
    for (const MethodSummary& method : group.methods)
        widest = std::max(widest, method.method.size());
    for (const Metric& metric : metrics()) {
        for (const MethodSummary& method : group.methods) {
            const auto value = method.values.find(metric.key);
            if (value == method.values.end())
                continue;
            const bool first = &method == &group.methods.front();
            result += printed("  %s  %-*s  %-28s", padded_title(metric).c_str(), int(widest), method.method.c_str(),
                              with_interval(value->second, metric.digits).c_str());
            const auto over = method.over_baseline.find(metric.key);
            if (!first && over != method.over_baseline.end())
                result += "  " + with_interval(over->second, metric.digits, "+") +
                          (is_within_noise(over->second) ? ", within the noise" : "");
            result.erase(result.find_last_not_of(' ') + 1);
            result += "\n";
        }
    }
    return result + "\n";
}

/// In lines of at most 100 bytes.
std::string wrapped(const std::string& paragraph)
{
    std::string result, line;
    std::istringstream words(paragraph);
    for (std::string word; words >> word;) {
        if (!line.empty() && line.size() + word.size() >= 100) {
            result += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return result + line + "\n";
}

} // namespace

std::string score_table(const Evaluation& evaluation, bool by_camera)
{
    std::string result;
    for (const GroupSummary& group : evaluation.groups)
        if (by_camera || group.camera.empty())
            result += group_table(evaluation, group);
    if (!evaluation.methods.empty())
        result +=
            "Brackets: bootstrap 95 % intervals over files. Last column: over " + evaluation.methods.front() + ".\n";
    for (const std::string& paragraph : evaluation.protocol_text)
        result += "\n" + wrapped(paragraph);
    result += "\n";
    for (const auto& [name, value] : evaluation.settings)
        result += name + ": " + value + "\n";
    return result;
}

} // namespace srisp::tool
