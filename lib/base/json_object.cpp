// SPDX-License-Identifier: Apache-2.0
#include "base/json_object.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/near_names.h"

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

JsonObjectReader::JsonObjectReader(const json& object, std::string where) : m_object(object), m_where(std::move(where))
{
    if (!object.is_object())
        fail("is not a JSON object");
}

const json* JsonObjectReader::take_optional(const std::string& key)
{
    if (std::find(m_known.begin(), m_known.end(), key) == m_known.end())
        m_known.push_back(key);
    const auto found = m_error.empty() ? m_object.find(key) : m_object.end();
    return found == m_object.end() ? nullptr : &*found;
}

const json& JsonObjectReader::take(const std::string& key)
{
    static const json nothing;
    if (const json* found = take_optional(key))
        return *found;
    fail("has no '" + key + "'");
    return nothing;
}

std::string JsonObjectReader::take_text(const std::string& key)
{
    const json& value = take(key);
    if (m_error.empty() && !value.is_string())
        fail("'" + key + "' must be a string");
    return m_error.empty() ? value.get<std::string>() : std::string();
}

std::vector<std::vector<float>> JsonObjectReader::take_lists(const std::string& key, std::size_t count)
{
    std::vector<std::vector<float>> lists;
    const json& value = take(key);
    if (m_error.empty() && (!value.is_array() || value.size() != count))
        fail("'" + key + "' must be a list of " + std::to_string(count) + " lists");
    if (m_error.empty())
        for (const json& element : value)
            lists.push_back(as_list(element, key));
    lists.resize(count);
    return lists;
}

void JsonObjectReader::fail(const std::string& reason)
{
    if (m_error.empty())
        m_error = m_where + " " + reason;
}

Status JsonObjectReader::finish()
{
    if (m_error.empty())
        for (const auto& [key, value] : m_object.items())
            if (std::find(m_known.begin(), m_known.end(), key) == m_known.end())
                fail("has an unknown key '" + key + "'" + near_names(key, m_known));
    return m_error.empty() ? Status() : Status(Error{ m_error });
}

float JsonObjectReader::as_number(const json& value, const std::string& key)
{
    if (m_error.empty() && (!value.is_number() || !std::isfinite(static_cast<float>(value.get<double>()))))
        fail("'" + key + "' must hold finite numbers, has " + value.dump());
    return m_error.empty() ? static_cast<float>(value.get<double>()) : 0;
}

std::vector<float> JsonObjectReader::as_list(const json& value, const std::string& key)
{
    std::vector<float> numbers;
    if (m_error.empty() && !value.is_array())
        fail("'" + key + "' must be a list of numbers");
    if (m_error.empty())
        for (const json& element : value)
            numbers.push_back(as_number(element, key));
    return numbers;
}

} // namespace srisp
