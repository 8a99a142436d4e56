// SPDX-License-Identifier: Apache-2.0
#include "score_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/input_file.h"
#include "base/json_text.h"
#include "base/shown_text.h"
#include "metric_table.h"

namespace srisp::tool {

namespace {

using Json = nlohmann::ordered_json;

constexpr char kFormat[] = "srisp-scores-1";
constexpr std::size_t kMostBytes = std::size_t(1) << 30;

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

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
        json[metric.key] = number(value->second.value());
        if (value->second.weight != 1)
            weights[metric.key] = value->second.weight;
    }
    for (const Measured& level : score.error_by_level)
        levels.push_back({ number(level.value()), level.weight });
    json["weights"] = weights;
    json["error_by_level"] = levels;
    json["chromaticity"] = chromaticity_json(score.chromaticity);
    const auto parameters = parse_json<Json>(score.parameters);
    json["parameters"] = parameters ? *parameters : Json(nullptr);
    return json;
}

/// Thrown where a file is not as it should be.
struct Wrong {
    std::string what;
};

double number_of(const nlohmann::json& json, const std::string& where)
{
    if (json.is_null())
        return std::nan("");
    if (!json.is_number())
        throw Wrong{ "'" + where + "' is no number" };
    return json.get<double>();
}

std::optional<Chromaticity> chromaticity_of_json(const nlohmann::json& parent, const char* key)
{
    const auto found = parent.find(key);
    if (found == parent.end() || found->is_null())
        return {};
    if (!found->is_array() || found->size() != 2)
        throw Wrong{ std::string("'") + key + "' is no pair of numbers" };
    return Chromaticity{ number_of((*found)[0], key), number_of((*found)[1], key) };
}

Measured measured(double value, double weight)
{
    return std::isfinite(value) && weight > 0 ? Measured{ value * weight, weight } : Measured{};
}

MethodScore method_of_json(const nlohmann::json& json)
{
    if (!json.is_object())
        throw Wrong{ "the scores of a method are no object" };
    MethodScore score;
    const nlohmann::json none = nlohmann::json::object();
    const auto found = json.find("weights");
    const nlohmann::json& weights = found != json.end() && found->is_object() ? *found : none;
    for (const Metric& metric : metrics()) {
        const auto value = json.find(metric.key);
        if (value == json.end())
            continue;
        const auto weight = weights.find(metric.key);
        score.values[metric.key] =
            measured(number_of(*value, metric.key), weight == weights.end() ? 1 : number_of(*weight, metric.key));
    }
    const auto levels = json.find("error_by_level");
    if (levels != json.end() && levels->is_array() && levels->size() == score.error_by_level.size())
        for (std::size_t i = 0; i < levels->size(); ++i)
            if ((*levels)[i].is_array() && (*levels)[i].size() == 2)
                score.error_by_level[i] =
                    measured(number_of((*levels)[i][0], "error_by_level"), number_of((*levels)[i][1], "weight"));
    score.chromaticity = chromaticity_of_json(json, "chromaticity");
    const auto parameters = json.find("parameters");
    if (parameters != json.end() && !parameters->is_null())
        score.parameters = parameters->dump();
    return score;
}

std::string text_of(const nlohmann::json& json, const char* key)
{
    const auto found = json.find(key);
    if (found == json.end() || !found->is_string())
        throw Wrong{ std::string("an image has no text '") + key + "'" };
    return found->get<std::string>();
}

ImageScore image_of_json(const nlohmann::json& json)
{
    ImageScore image;
    if (!json.is_object())
        throw Wrong{ "an image is no object" };
    image.image = text_of(json, "image");
    image.part = text_of(json, "part");
    image.rendering = text_of(json, "rendering");
    image.camera = text_of(json, "camera");
    image.reference = text_of(json, "reference");
    image.width = int(number_of(json.value("width", nlohmann::json(0)), "width"));
    image.height = int(number_of(json.value("height", nlohmann::json(0)), "height"));
    image.reference_chromaticity = chromaticity_of_json(json, "reference_chromaticity");
    image.truth_chromaticity = chromaticity_of_json(json, "truth_chromaticity");
    if (const auto notes = json.find("notes"); notes != json.end() && notes->is_array())
        for (const nlohmann::json& note : *notes)
            if (note.is_string())
                image.notes.push_back(note.get<std::string>());
    const auto methods = json.find("methods");
    if (methods == json.end() || !methods->is_object())
        throw Wrong{ "an image has no 'methods'" };
    for (const auto& [name, score] : methods->items())
        image.methods[name] = method_of_json(score);
    return image;
}

Json interval_json(const Interval& interval)
{
    return Json::array({ number(interval.mean), number(interval.low), number(interval.high) });
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

std::string csv_text(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csv_number(double value)
{
    char text[32] = "";
    if (std::isfinite(value))
        std::snprintf(text, sizeof text, "%.7g", value);
    return text;
}

std::string dump(const Json& json, int indent)
{
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace

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

Expected<ImageScore> image_score_from_json(const nlohmann::json& json)
{
    try {
        return image_of_json(json);
    } catch (const Wrong& wrong) {
        return Error{ wrong.what };
    }
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
    return dump({ { "format", kFormat },
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

Expected<Evaluation> read_evaluation(const std::string& path)
{
    const auto fail = [&](const std::string& reason) { return Error{ "'" + shown_text(path) + "': " + reason }; };
    const auto text = read_file(path, kMostBytes, "'" + shown_text(path) + "'");
    if (!text)
        return text.error();
    const auto json = parse_json<nlohmann::json>(*text, kMostBytes);
    if (!json)
        return fail(json.error().message);
    if (!json->is_object() || json->value("format", nlohmann::json()) != kFormat)
        return fail("is no file of scores that srispeval wrote with --json (format " + std::string(kFormat) + ")");
    const auto images = json->find("images"), methods = json->find("methods");
    if (images == json->end() || !images->is_array() || methods == json->end() || !methods->is_array())
        return fail("has no 'images' and 'methods'");
    Evaluation evaluation;
    if (const auto protocol = json->find("protocol"); protocol != json->end() && protocol->is_string())
        evaluation.protocol = protocol->get<std::string>();
    for (const nlohmann::json& name : *methods)
        if (name.is_string())
            evaluation.methods.push_back(name.get<std::string>());
    for (const nlohmann::json& image : *images) {
        auto score = image_score_from_json(image);
        if (!score)
            return fail(score.error().message);
        evaluation.images.push_back(std::move(*score));
    }
    return evaluation;
}

std::string to_csv(const Evaluation& evaluation)
{
    std::string text = "image,part,rendering,camera,reference,method";
    for (const Metric& metric : metrics())
        text += std::string(",") + metric.key;
    text += "\n";
    for (const ImageScore& image : evaluation.images)
        for (const std::string& method : evaluation.methods) {
            const auto score = image.methods.find(method);
            if (score == image.methods.end())
                continue;
            text += csv_text(image.image) + "," + image.part + "," + csv_text(image.rendering) + "," +
                    csv_text(image.camera) + "," + csv_text(image.reference) + "," + csv_text(method);
            for (const Metric& metric : metrics()) {
                const auto value = score->second.values.find(metric.key);
                text += "," + (value == score->second.values.end() ? "" : csv_number(value->second.value()));
            }
            text += "\n";
        }
    return text;
}

} // namespace srisp::tool
