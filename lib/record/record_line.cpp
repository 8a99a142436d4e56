// SPDX-License-Identifier: Apache-2.0
#include "record/record_line.h"

#include <nlohmann/json.hpp>

namespace srisp {

namespace {

using nlohmann::ordered_json;

const char kStart[] = "{\"srisp\":";

/// The JSON object at `start`, to its closing brace; empty where it does not close.
std::string object_at(const std::string& text, std::size_t start)
{
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = start; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && c == '{')
            ++depth;
        else if (!quoted && c == '}' && --depth == 0)
            return text.substr(start, i + 1 - start);
    }
    return "";
}

} // namespace

const char* synthetic_mark(Direction direction)
{
    return direction == Direction::reverse ? "synthetic RAW-like image, computed from a photo; no sensor recorded it"
                                           : "synthetic image, processed from a RAW-like one; no camera made it";
}

std::string format_record(const RecordLine& record)
{
    ordered_json line = { { "srisp", synthetic_mark(record.direction) },
                          { "direction", record.direction == Direction::reverse ? "reverse" : "forward" } };
    if (!record.parameters.empty())
        line["parameters"] = ordered_json::parse(record.parameters, nullptr, false);
    if (!record.description.empty())
        line["description"] = record.description;
    return line.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

bool find_record(const std::string& text, RecordLine& record)
{
    const std::size_t start = text.find(kStart);
    if (start == std::string::npos)
        return false;
    const ordered_json line = ordered_json::parse(object_at(text, start), nullptr, false);
    if (!line.is_object())
        return false;
    const auto text_of = [&](const char* key) {
        const auto found = line.find(key);
        return found != line.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    record.direction = text_of("direction") == "forward" ? Direction::forward : Direction::reverse;
    record.description = text_of("description");
    record.parameters = line.contains("parameters") ? line["parameters"].dump() : "";
    return true;
}

} // namespace srisp
