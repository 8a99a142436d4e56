// SPDX-License-Identifier: Apache-2.0
#include "image_details.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/json_text.h"
#include "base/printed.h"
#include "base/shown_text.h"
#include "html_text.h"

namespace srisp::tool {

namespace {

using nlohmann::ordered_json;

bool is_short_list(const ordered_json& value)
{
    return value.is_array() &&
           std::none_of(value.begin(), value.end(), [](const ordered_json& one) { return one.is_structured(); });
}

std::string scalar(const ordered_json& value)
{
    if (value.is_number_float())
        return printed("%.5g", value.get<double>());
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string readable(const ordered_json& value, std::size_t depth) // depth: parse_json's limit
{
    if (!value.is_structured() || value.empty())
        return scalar(value);
    const bool one_line = is_short_list(value);
    const std::string indent = one_line ? " " : "\n" + std::string(2 * (depth + 1), ' ');
    std::string text;
    for (const auto& [key, member] : value.items())
        text += (text.empty() ? "" : ",") + (one_line && text.empty() ? "" : indent) +
                (value.is_object() ? scalar(key) + ": " : "") + readable(member, depth + 1);
    if (!one_line)
        text += "\n" + std::string(2 * depth, ' ');
    return (value.is_object() ? "{" : "[") + text + (value.is_object() ? "}" : "]");
}

/// "62 % of no. 3, 21 % of no. 0" for what weighs most.
std::string heaviest(const ordered_json& weights)
{
    constexpr std::size_t kMost = 4;
    constexpr double kLightest = 0.01;
    std::vector<double> values;
    for (const ordered_json& one : weights)
        values.push_back(one.is_number() ? one.get<double>() : 0);
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
    std::string text;
    for (std::size_t i = 0; i < std::min(kMost, order.size()); ++i)
        if (values[order[i]] >= kLightest)
            text += (text.empty() ? "" : ", ") + number(values[order[i]] * 100, 0) + " % of no. " +
                    std::to_string(order[i]);
    return text;
}

std::string weights_row(const std::string& name, const ordered_json& weights)
{
    const std::string text = heaviest(weights);
    return text.empty() ? "" : "<tr><th scope=\"row\">" + html(name) + "</th><td>" + text + "</td></tr>\n";
}

std::string parameters_html(const std::string& method, const std::string& parameters)
{
    return "<details><summary>What " + html(method) + " chose</summary>\n" + weights_html(parameters) + "<pre>" +
           html(readable_parameters(parameters)) + "</pre></details>\n";
}

double value_of(const MethodScore& score, const Metric& metric)
{
    const auto found = score.values.find(metric.key);
    return found != score.values.end() ? found->second.value() : NAN;
}

std::string numbers_table(const Evaluation& evaluation, const ImageScore& image)
{
    std::vector<const Metric*> columns;
    for (const Metric& metric : metrics())
        if (std::any_of(image.methods.begin(), image.methods.end(),
                        [&](const auto& one) { return std::isfinite(value_of(one.second, metric)); }))
            columns.push_back(&metric);
    if (columns.empty())
        return "";
    std::string text =
        "<div class=\"wide\" role=\"group\" tabindex=\"0\" aria-label=\"Numbers\"><table class=\"numbers\">\n"
        "<caption class=\"hidden\">Numbers of this image</caption>\n<thead><tr><th scope=\"col\">method</th>";
    for (const Metric* metric : columns)
        text += "<th scope=\"col\" class=\"n\" title=\"" + html(metric->text) + "\">" + html(title_with_unit(*metric)) +
                "</th>";
    text += "</tr></thead>\n<tbody>\n";
    for (const std::string& method : evaluation.methods) {
        const auto score = image.methods.find(method);
        if (score == image.methods.end())
            continue;
        text += "<tr><th scope=\"row\">" + html(method) + "</th>";
        for (const Metric* metric : columns) {
            text += "<td class=\"n\">" + number(value_of(score->second, *metric), metric->digits) + "</td>";
        }
        text += "</tr>\n";
    }
    return text + "</tbody>\n</table></div>\n";
}

} // namespace

std::string readable_parameters(const std::string& json_text)
{
    const auto value = parse_json<ordered_json>(json_text);
    return value ? readable(*value, 0) : json_text;
}

std::string weights_html(const std::string& json_text)
{
    const auto value = parse_json<ordered_json>(json_text);
    if (!value || !value->is_object() || !value->contains("weights") || !value->at("weights").is_object())
        return "";
    std::string rows;
    for (const auto& [name, weights] : value->at("weights").items()) {
        if (is_short_list(weights))
            rows += weights_row(name, weights);
        else if (weights.is_array())
            for (std::size_t i = 0; i < weights.size(); ++i)
                if (is_short_list(weights[i]))
                    rows += weights_row(name + " " + std::to_string(i + 1), weights[i]);
    }
    return rows.empty() ? ""
                        : "<table><caption>The heaviest weights</caption>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string image_details_html(const Evaluation& evaluation, const ImageScore& image)
{
    std::string text = numbers_table(evaluation, image);
    if (!image.notes.empty()) {
        text += "<ul class=\"notes\" aria-label=\"Notes\">";
        for (const std::string& note : image.notes)
            text += "<li>" + html(note) + "</li>";
        text += "</ul>\n";
    }
    for (const std::string& method : evaluation.methods) {
        const auto score = image.methods.find(method);
        if (score != image.methods.end() && !score->second.parameters.empty())
            text += parameters_html(method, score->second.parameters);
    }
    return text;
}

} // namespace srisp::tool
