// SPDX-License-Identifier: Apache-2.0
#include "base/json_object.h"

#include <algorithm>
#include <cmath>

#include "base/near_names.h"
#include "base/shown_text.h"

namespace srisp {

using nlohmann::json;

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

std::optional<float> JsonObjectReader::take_optional_number(const std::string& key)
{
    const json* const value = take_optional(key);
    return value ? std::optional<float>(as_number(*value, key)) : std::nullopt;
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
    // Ends at the first error: there may be any number of unknown keys.
    for (auto entry = m_object.begin(); m_error.empty() && entry != m_object.end(); ++entry)
        if (std::find(m_known.begin(), m_known.end(), entry.key()) == m_known.end())
            fail("has an unknown key '" + shown_text(entry.key()) + "'" + near_names(entry.key(), m_known));
    return m_error.empty() ? Status() : Status(Error{ m_error });
}

float JsonObjectReader::as_number(const json& value, const std::string& key)
{
    if (m_error.empty() && (!value.is_number() || !std::isfinite(static_cast<float>(value.get<double>()))))
        fail("'" + key + "' must hold finite numbers, has " + shown_json(value));
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
