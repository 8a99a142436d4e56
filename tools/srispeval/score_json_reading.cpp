// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "base/input_file.h"
#include "base/json_text.h"
#include "base/shown_text.h"
#include "metric_table.h"
#include "score_json.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kMostBytes = std::size_t(1) << 30;

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

/// Pixels of a side; 0 where the file does not say.
int side_of(const nlohmann::json& json, const char* key)
{
    const nlohmann::json side = json.value(key, nlohmann::json(0));
    if (!side.is_number_integer() || side < 0 || side > std::numeric_limits<int>::max())
        throw Wrong{ std::string("'") + key + "' is no count of pixels" };
    return side.get<int>();
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
    image.width = side_of(json, "width");
    image.height = side_of(json, "height");
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

} // namespace

Expected<ImageScore> image_score_from_json(const nlohmann::json& json)
{
    try {
        return image_of_json(json);
    } catch (const Wrong& wrong) {
        return Error{ wrong.what };
    }
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
    if (!json->is_object() || json->value("format", nlohmann::json()) != kScoresFormat)
        return fail("is no file of scores that srispeval wrote with --json (format " + std::string(kScoresFormat) +
                    ")");
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

} // namespace srisp::tool
