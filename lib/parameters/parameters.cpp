// SPDX-License-Identifier: Apache-2.0
#include <srisp/parameters.h>

#include <algorithm>
#include <cmath>

#include <srisp/model.h>

#include "base/guarded.h"
#include "base/json_object.h"
#include "base/matrix3.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

using nlohmann::json;

const char kFormat[] = "srisp-parameters-1";

/// 9 significant digits bring a float back to the bit.
std::string number(double value)
{
    return shown_number(value, 9);
}

template<class Values> std::string list(const Values& values)
{
    std::string text = "[";
    for (const float value : values)
        text += (text.size() > 1 ? ", " : "") + number(value);
    return text + "]";
}

std::string rows(const std::array<float, 9>& matrix)
{
    std::string text;
    for (int row = 0; row < 3; ++row)
        text += (row ? ", " : "[") +
                list(std::array<float, 3>{ matrix[row * 3], matrix[row * 3 + 1], matrix[row * 3 + 2] });
    return text + "]";
}

std::string quoted(const std::string& text)
{
    // Paths need not be UTF-8: what is not is replaced rather than refused.
    return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Writes "key": value lines of one object. nlohmann's own dump puts every number of an array on a line of its own.
class ObjectText {
public:
    explicit ObjectText(int indent, int depth) : m_indent(indent), m_depth(depth) {}

    ObjectText& add(const std::string& key, const std::string& value)
    {
        m_text += (m_text.empty() ? "{" : ",") + line(m_depth + 1) + "\"" + key + "\": " + value;
        return *this;
    }
    std::string text() const { return m_text + line(m_depth) + "}"; }

private:
    std::string line(int depth) const
    {
        if (m_indent < 0)
            return m_text.empty() || depth == m_depth ? "" : " ";
        return "\n" + std::string(std::size_t(m_indent) * depth, ' ');
    }

    std::string m_text;
    int m_indent, m_depth;
};

void read_named_hash(JsonObjectReader& reader, const std::string& key, const std::string& where, std::string& name,
                     std::string& hash)
{
    const json& object = reader.take(key);
    if (!object.is_object())
        return reader.fail("'" + key + "' must be an object with name and hash");
    JsonObjectReader inner(object, where + ": '" + key + "'");
    name = inner.take_text("name");
    hash = inner.take_text("hash");
    if (Status status = inner.finish(); !status)
        reader.fail("is refused: " + status.error().message);
}

void read_weights(JsonObjectReader& reader, const std::string& where, Parameters& parameters)
{
    const json& object = reader.take("weights");
    if (!object.is_object())
        return reader.fail("'weights' must be an object");
    JsonObjectReader inner(object, where + ": 'weights'");
    const auto tone = inner.take_lists("tone", 4);
    std::copy(tone.begin(), tone.end(), parameters.tone_weights.begin());
    parameters.gamma_weights = inner.take_list("gamma");
    parameters.color_weights = inner.take_list("color");
    parameters.white_balance_weights = inner.take_list("white_balance");
    parameters.gain_weights = inner.take_list("gain");
    if (Status status = inner.finish(); !status)
        reader.fail("is refused: " + status.error().message);
}

std::string weights_text(const Parameters& parameters, int indent)
{
    std::string tone;
    for (const std::vector<float>& weights : parameters.tone_weights)
        tone += (tone.empty() ? "[" : ", ") + list(weights);
    return ObjectText(indent, 1)
        .add("tone", tone + "]")
        .add("gamma", list(parameters.gamma_weights))
        .add("color", list(parameters.color_weights))
        .add("white_balance", list(parameters.white_balance_weights))
        .add("gain", list(parameters.gain_weights))
        .text();
}

std::string named_hash_text(const std::string& name, const std::string& hash)
{
    return ObjectText(-1, 1).add("name", quoted(name)).add("hash", quoted(hash)).text();
}

/// Whether `apply` can use the values. `what` starts the message.
Status check_values(const Parameters& parameters, const std::string& what)
{
    const auto positive = [&](const std::string& key, float value) -> Status {
        if (std::isfinite(value) && value > 0)
            return {};
        return Error{ what + ": '" + key + "' has " + number(value) + ", must be finite and > 0" };
    };
    if (Status status = positive("gain", parameters.gain); !status)
        return status;
    if (Status status = positive("gamma", parameters.gamma); !status)
        return status;
    for (const float value : parameters.white_balance)
        if (Status status = positive("white_balance", value); !status)
            return status;
    const float sd = parameters.brightness_sd_ev.value_or(0.0f);
    if (!(sd >= 0 && sd <= kLargestBrightnessEv))
        return Error{ what + ": 'brightness_sd_ev' has " + number(sd) + ", must be 0 to " +
                      number(kLargestBrightnessEv) };
    if (!std::isfinite(parameters.brightness_ev))
        return Error{ what + ": 'brightness_ev' has " + number(parameters.brightness_ev) + ", must be finite" };
    // Below this an inverse magnifies the last bit of a float to 1 % of full scale.
    if (!(std::abs(determinant(parameters.color)) > 1e-5))
        return Error{ what + ": 'color' is singular (determinant " + number(determinant(parameters.color)) + ")" };
    return {};
}

} // namespace

std::string to_json(const Parameters& parameters, int indent)
{
    ObjectText text(indent, 0);
    text.add("format", quoted(kFormat)).add("gain", number(parameters.gain));
    if (parameters.brightness_ev != 0)
        text.add("brightness_ev", number(parameters.brightness_ev));
    if (parameters.brightness_sd_ev)
        text.add("brightness_sd_ev", number(*parameters.brightness_sd_ev));
    return text.add("white_balance", list(parameters.white_balance))
        .add("color", rows(parameters.color))
        .add("gamma", number(parameters.gamma))
        .add("weights", weights_text(parameters, indent))
        .add("model", named_hash_text(parameters.model_name, parameters.model_hash))
        .add("reference", named_hash_text(parameters.reference_name, parameters.reference_hash))
        .text();
}

Expected<Parameters> parameters_from_json(const std::string& text, const std::string& where)
{
    return guarded("parameters", {}, [&]() -> Expected<Parameters> {
        const std::string what = "parameters in " + where;
        const auto parsed = parse_json<json>(text);
        if (!parsed)
            return Error{ what + ": " + parsed.error().message };
        const json& object = *parsed;
        JsonObjectReader reader(object, what);
        Parameters parameters;
        if (object.is_object() && object.contains("image")) // what srisptool prints: whose parameters they are
            reader.take_text("image");
        if (const std::string format = reader.take_text("format"); format != kFormat)
            reader.fail("have format '" + shown_text(format) + "', must be '" + kFormat + "'");
        parameters.gain = reader.take_number("gain");
        parameters.brightness_ev = reader.take_optional_number("brightness_ev").value_or(0.0f);
        parameters.brightness_sd_ev = reader.take_optional_number("brightness_sd_ev");
        const std::vector<float> white_balance = reader.take_list("white_balance");
        if (white_balance.size() == 3)
            std::copy_n(white_balance.begin(), 3, parameters.white_balance.begin());
        else
            reader.fail("'white_balance' must have 3 numbers, has " + std::to_string(white_balance.size()));
        const auto color = reader.take_lists("color", 3);
        for (int row = 0; row < 3; ++row)
            if (color[row].size() == 3)
                std::copy_n(color[row].begin(), 3, parameters.color.begin() + row * 3);
            else
                reader.fail("'color' must be 3 rows of 3 numbers");
        parameters.gamma = reader.take_number("gamma");
        read_weights(reader, what, parameters);
        read_named_hash(reader, "model", what, parameters.model_name, parameters.model_hash);
        read_named_hash(reader, "reference", what, parameters.reference_name, parameters.reference_hash);
        if (Status status = reader.finish(); !status)
            return status.error();
        if (Status status = check_values(parameters, what); !status)
            return status.error();
        return parameters;
    });
}

Status check_parameters(const Parameters& parameters, const Model& model)
{
    return guarded("parameters", {}, [&]() -> Status {
        if (parameters.model_hash != model.hash())
            return Error{ "parameters were chosen with model '" + shown_text(parameters.model_name) + "' (" +
                          shown_text(parameters.model_hash) + "), but '" + model.path() + "' is " + model.hash() };
        for (const std::vector<float>& weights : parameters.tone_weights)
            if (static_cast<int>(weights.size()) != model.dictionary_size())
                return Error{ "parameters have " + std::to_string(weights.size()) + " tone weights per layer, model '" +
                              model.name() + "' needs " + std::to_string(model.dictionary_size()) };
        return check_values(parameters, "parameters");
    });
}

} // namespace srisp
