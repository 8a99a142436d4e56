// SPDX-License-Identifier: Apache-2.0
#include "score_json.h"

#include <cmath>

#include "base/json_text.h"
#include "metric_table.h"

namespace srisp::tool {

namespace {

using Json = nlohmann::ordered_json;

Json chromaticity_json(const std::optional<Chromaticity>& chromaticity)
{
    return chromaticity ? Json(*chromaticity) : Json(nullptr);
}

Json method_json(const MethodScore& score)
{
    Json json = Json::object(), weights = Json::object(), levels = Json::array();
    for (const Metric& metric : metrics()) {
        const auto value = score.values.find(metric.key);
        if (value == score.values.end())
            continue;
        json[metric.key] = json_number(value->second.value());
        if (value->second.weight != 1)
            weights[metric.key] = value->second.weight;
    }
    for (const Measured& level : score.error_by_level)
        levels.push_back({ json_number(level.value()), level.weight });
    json["weights"] = weights;
    json["error_by_level"] = levels;
    json["chromaticity"] = chromaticity_json(score.chromaticity);
    const auto parameters = parse_json<Json>(score.parameters);
    json["parameters"] = parameters ? *parameters : Json(nullptr);
    return json;
}

Json interval_json(const Interval& interval)
{
    return Json::array({ json_number(interval.mean), json_number(interval.low), json_number(interval.high) });
}

Json intervals_json(const std::map<std::string, Interval>& values)
{
    Json json = Json::object();
    for (const Metric& metric : metrics())
        if (const auto value = values.find(metric.key); value != values.end())
            json[metric.key] = interval_json(value->second);
    return json;
}

Json group_json(const GroupSummary& group)
{
    Json methods = Json::array();
    for (const MethodSummary& method : group.methods) {
        Json levels = Json::array();
        for (const Interval& level : method.error_by_level)
            levels.push_back(interval_json(level));
        methods.push_back({ { "method", method.method },
                            { "values", intervals_json(method.values) },
                            { "over_baseline", intervals_json(method.over_baseline) },
                            { "brightness_spread", interval_json(method.brightness_spread) },
                            { "error_by_level", levels },
                            { "coverage", method.coverage } });
    }
    return { { "rendering", group.rendering }, { "camera", group.camera.empty() ? Json(nullptr) : Json(group.camera) },
             { "images", group.images },       { "files", group.files },
             { "cameras", group.cameras },     { "methods", methods } };
}

std::string dump(const Json& json, int indent)
{
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace

Json json_number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json to_json(const ImageScore& image)
{
    Json methods = Json::object();
    for (const auto& [name, score] : image.methods)
        methods[name] = method_json(score);
    return { { "image", image.image },
             { "part", image.part },
             { "rendering", image.rendering },
             { "camera", image.camera },
             { "reference", image.reference },
             { "width", image.width },
             { "height", image.height },
             { "reference_chromaticity", chromaticity_json(image.reference_chromaticity) },
             { "truth_chromaticity", chromaticity_json(image.truth_chromaticity) },
             { "notes", image.notes },
             { "methods", methods } };
}

std::string to_json(const Evaluation& evaluation, int indent)
{
    Json settings = Json::object(), images = Json::array(), groups = Json::array(), left_out = Json::array();
    for (const auto& [name, value] : evaluation.settings)
        settings[name] = value;
    for (const GroupSummary& group : evaluation.groups)
        groups.push_back(group_json(group));
    for (const ImageScore& image : evaluation.images)
        images.push_back(to_json(image));
    for (const LeftOut& one : evaluation.left_out)
        left_out.push_back({ { "file", one.file }, { "reason", one.reason } });
    return dump({ { "format", kScoresFormat },
                  { "srisp", evaluation.version },
                  { "protocol", evaluation.protocol },
                  { "how", evaluation.protocol_text },
                  { "settings", settings },
                  { "methods", evaluation.methods },
                  { "complete", evaluation.complete },
                  { "intervals", "mean, then the bootstrap 95 % interval over files" },
                  { "groups", groups },
                  { "left_out", left_out },
                  { "images", images } },
                indent) +
           "\n";
}

} // namespace srisp::tool
