// SPDX-License-Identifier: Apache-2.0
#include "base/strict_json.h"

#include <algorithm>
#include <set>
#include <vector>

namespace srisp {

using nlohmann::json;

/// "line 3, column 7" of a byte, counted from 1.
static std::string place(const std::string& text, std::size_t byte)
{
    const std::string before = text.substr(0, std::min(byte, text.size()));
    const std::size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
    return "line " + std::to_string(std::count(before.begin(), before.end(), '\n') + 1) + ", column " +
           std::to_string(std::max<std::size_t>(1, byte - line_start));
}

Expected<json> parse_json_object(const std::string& text, const std::string& where, const std::string& part)
{
    std::vector<std::set<std::string>> open_objects;
    std::string duplicate;
    const auto watch = [&](int, json::parse_event_t event, json& parsed) {
        if (event == json::parse_event_t::object_start)
            open_objects.emplace_back();
        else if (event == json::parse_event_t::object_end)
            open_objects.pop_back();
        else if (event == json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second)
            duplicate = parsed.get<std::string>();
        return true;
    };
    const std::string message = where + ": " + part + " is not a JSON object";
    json object;
    try {
        object = json::parse(text, watch);
    } catch (const json::parse_error& error) {
        return Error{ message + " (" + place(text, error.byte) + ")" };
    } catch (const json::out_of_range&) { // the one other thing that parse throws
        return Error{ message + " that can be read (a number is too large)" };
    }
    if (!object.is_object())
        return Error{ message };
    if (!duplicate.empty())
        return Error{ where + ": '" + duplicate + "' appears twice in the " + part };
    return object;
}

} // namespace srisp
