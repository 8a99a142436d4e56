// SPDX-License-Identifier: Apache-2.0
#include "report_summary.h"

#include <algorithm>
#include <cmath>

#include "html_text.h"
#include "report_words.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kMostColumns = 9; ///< of one table

/// A column of a table of methods: a metric, or the spread of the brightness.
struct Column {
    std::string title, text;
    int digits = 2;
    Better better = Better::near_zero;
    std::string key; ///< "": the spread
};

Interval value_of(const MethodSummary& method, const Column& column)
{
    if (column.key.empty())
        return method.brightness_spread;
    const auto found = method.values.find(column.key);
    return found != method.values.end() ? found->second : Interval{ NAN, NAN, NAN };
}

Column spread_column()
{
    return { "spread of ln mean error", "standard deviation of the brightness error over images", 3, Better::lower,
             "" };
}

/// What at least one of these methods has.
std::vector<Column> columns_of(const std::vector<MethodSummary>& methods)
{
    std::vector<Column> columns;
    const auto has = [&](const Column& column) {
        return std::any_of(methods.begin(), methods.end(),
                           [&](const MethodSummary& one) { return std::isfinite(value_of(one, column).mean); });
    };
    for (const Metric& one : metrics()) {
        const Column column{ title_with_unit(one), one.text, one.digits, one.better, one.key };
        if (has(column))
            columns.push_back(column);
        if (one.key == std::string(key::kBrightness) && has(column) && has(spread_column()))
            columns.push_back(spread_column());
    }
    return columns;
}

std::string head_cell(const Column& column)
{
    return "<th scope=\"col\" class=\"n\" title=\"" + html(column.text) + "\">" + html(column.title) + "</th>";
}

std::string small(const std::string& text)
{
    return text.empty() ? "" : "<small>" + text + "</small>";
}

std::string value_cell(const MethodSummary& method, const Column& column)
{
    const Interval value = value_of(method, column);
    return "<td class=\"n\">" + number(value.mean, column.digits) + small(range_text(value, column.digits)) + "</td>";
}

/// What a difference means, in a word; nothing where neither sign is the good one.
std::string verdict(const Interval& difference, Better better)
{
    if (is_within_noise(difference))
        return "<small class=\"noise\">within the noise</small>";
    if (better == Better::near_zero)
        return "";
    const bool good = (difference.mean > 0) == (better == Better::higher);
    return good ? "<small class=\"good\">better</small>" : "<small class=\"bad\">worse</small>";
}

std::string difference_cell(const MethodSummary& method, const Column& column)
{
    const auto found = method.over_baseline.find(column.key);
    if (found == method.over_baseline.end() || !std::isfinite(found->second.mean))
        return "<td></td>";
    const Interval& difference = found->second;
    return "<td class=\"n\">" + signed_number(difference.mean, column.digits) +
           small(signed_range_text(difference, column.digits)) + verdict(difference, column.better) + "</td>";
}

std::string method_rows(const MethodSummary& method, const std::string& baseline, const std::vector<Column>& columns)
{
    std::string text = "<tr><th scope=\"row\">" + html(method.method) + "</th>";
    for (const Column& column : columns)
        text += value_cell(method, column);
    text += "</tr>\n";
    const bool differs = std::any_of(columns.begin(), columns.end(),
                                     [&](const Column& column) { return method.over_baseline.count(column.key) > 0; });
    if (!differs)
        return text;
    text += "<tr class=\"difference\"><th scope=\"row\">minus " + html(baseline) + "</th>";
    for (const Column& column : columns)
        text += difference_cell(method, column);
    return text + "</tr>\n";
}

std::string open_table(const std::string& caption, const std::string& first, const std::vector<Column>& columns)
{
    std::string text = "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"" + caption +
                       "\"><table>\n<caption>" + caption + "</caption>\n<thead><tr>" + first;
    for (const Column& column : columns)
        text += head_cell(column);
    return text + "</tr></thead>\n";
}

constexpr char kEndOfTable[] = "</table></div>\n";

std::string group_tables(const GroupSummary& group)
{
    const std::vector<Column> columns = columns_of(group.methods);
    const std::string about = rendering_title(group.rendering) + ", " + counted(group.images, "image") + " from " +
                              counted(group.files, "file") + ", " + counted(group.cameras, "camera");
    std::string text;
    // Several tables: one as wide as all of it would be read through a keyhole.
    const std::size_t tables = (columns.size() + kMostColumns - 1) / kMostColumns;
    for (std::size_t table = 0; table < tables; ++table) {
        const std::size_t begin = columns.size() * table / tables, end = columns.size() * (table + 1) / tables;
        const std::vector<Column> part(columns.begin() + std::ptrdiff_t(begin), columns.begin() + std::ptrdiff_t(end));
        text += open_table(about + (begin > 0 ? ": further measures" : ""), "<th scope=\"col\">method</th>", part) +
                "<tbody>\n";
        for (const MethodSummary& method : group.methods)
            text += method_rows(method, group.methods[0].method, part);
        text += std::string("</tbody>\n") + kEndOfTable;
    }
    return text;
}

/// What the columns mean, for those who see no tooltips.
std::string definitions(const Evaluation& evaluation)
{
    std::vector<MethodSummary> methods;
    for (const GroupSummary& group : evaluation.groups)
        methods.insert(methods.end(), group.methods.begin(), group.methods.end());
    std::string text = "<details class=\"definitions\" open><summary>What the measures are</summary>\n<dl>\n";
    for (const Column& column : columns_of(methods))
        text += "<div><dt>" + html(column.title) + "</dt><dd>" + html(column.text) +
                (column.better == Better::higher  ? "; higher is better"
                 : column.better == Better::lower ? "; lower is better"
                                                  : "; near 0 is better") +
                "</dd></div>\n";
    return text + "</dl></details>\n";
}

/// The columns that matter most, of what any camera of this rendering has.
std::vector<Column> main_columns(const Evaluation& evaluation, const std::string& rendering)
{
    std::vector<MethodSummary> methods;
    for (const GroupSummary& group : evaluation.groups)
        if (group.rendering == rendering && !group.camera.empty())
            methods.insert(methods.end(), group.methods.begin(), group.methods.end());
    std::vector<Column> columns;
    for (const Column& column : columns_of(methods))
        for (const char* key : { key::kPsnr, key::kAngle, key::kDeltaE, key::kLab, key::kBrightness, key::kHighlights,
                                 key::kRankRed, key::kRankGreen, key::kRankBlue })
            if (column.key == key)
                columns.push_back(column);
    return columns;
}

std::string camera_rows(const GroupSummary& group, const std::vector<Column>& columns)
{
    std::string text = "<tbody>\n<tr class=\"group\"><th scope=\"rowgroup\" colspan=\"" +
                       std::to_string(columns.size() + 1) + "\">" + html(group.camera) + " <small>" +
                       counted(group.images, "image") + "</small></th></tr>\n";
    for (const MethodSummary& method : group.methods)
        text += method_rows(method, group.methods[0].method, columns);
    return text + "</tbody>\n";
}

} // namespace

std::string summary_html(const Evaluation& evaluation)
{
    std::string text =
        "<p class=\"prose\">Means over images; below each its bootstrap 95 % interval. A difference is taken "
        "image by image; where its interval holds 0 it is within the noise.</p>\n";
    for (const GroupSummary& group : evaluation.groups)
        if (group.camera.empty())
            text += group_tables(group);
    return text + definitions(evaluation);
}

std::string camera_tables_html(const Evaluation& evaluation)
{
    std::string text, rendering;
    std::vector<Column> columns;
    for (const GroupSummary& group : evaluation.groups) {
        if (group.camera.empty())
            continue;
        if (text.empty() || group.rendering != rendering) {
            rendering = group.rendering;
            columns = main_columns(evaluation, rendering);
            text += (text.empty() ? "" : kEndOfTable) + open_table(rendering_title(rendering) + ", by camera",
                                                                   "<th scope=\"col\">camera, method</th>", columns);
        }
        text += camera_rows(group, columns);
    }
    return text.empty() ? "" : text + kEndOfTable;
}

} // namespace srisp::tool
