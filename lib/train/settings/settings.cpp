// SPDX-License-Identifier: Apache-2.0
#include "train/settings/settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/json_text.h"
#include "base/near_names.h"
#include "base/shown_text.h"

namespace srisp::train {

using nlohmann::json;

namespace {

/// "0.001", "1e-05": as short as it can be read back by a person; recipes are written by nlohmann in full.
std::string number_text(double value)
{
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string interval_text(double low, double high)
{
    return number_text(low) + " to " + number_text(high);
}

std::string choices_text(const std::vector<std::string>& allowed)
{
    std::string text;
    for (const std::string& name : allowed)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

void flatten(const json& object, const std::string& prefix, json& values)
{
    for (const auto& [name, value] : object.items())
        if (value.is_object())
            flatten(value, prefix + name + ".", values);
        else
            values[prefix + name] = value;
}

bool within(const json& value, double low, double high)
{
    return value.is_number() && value.get<double>() >= low && value.get<double>() <= high;
}

} // namespace

void KeyedVisitor::enter(const char* group_name)
{
    m_prefix_lengths.push_back(m_prefix.size());
    m_prefix += std::string(group_name) + ".";
}

void KeyedVisitor::leave()
{
    m_prefix.resize(m_prefix_lengths.back());
    m_prefix_lengths.pop_back();
}

SettingsReader::SettingsReader(const json& object, std::string where)
    : m_values(flat_settings(object)), m_where(std::move(where))
{
}

const json* SettingsReader::find(const char* name)
{
    m_known.push_back(key(name));
    const auto found = m_values.find(m_known.back());
    return found == m_values.end() || !m_error.empty() ? nullptr : &*found;
}

void SettingsReader::fail(const char* name, const std::string& wanted, const json& value)
{
    m_error = m_where + ": '" + key(name) + "' must be " + wanted + ", has " + shown_json(value);
}

void SettingsReader::number(const char* name, double& value, double low, double high, const char*)
{
    const json* found = find(name);
    if (found && !within(*found, low, high))
        fail(name, "a number from " + interval_text(low, high), *found);
    else if (found)
        value = found->get<double>();
}

void SettingsReader::integer(const char* name, int& value, int low, int high, const char*)
{
    const json* found = find(name);
    if (found && (!within(*found, low, high) || found->get<double>() != std::floor(found->get<double>())))
        fail(name, "a whole number from " + std::to_string(low) + " to " + std::to_string(high), *found);
    else if (found)
        value = static_cast<int>(found->get<double>());
}

void SettingsReader::flag(const char* name, bool& value, const char*)
{
    const json* found = find(name);
    if (found && !found->is_boolean())
        fail(name, "true or false", *found);
    else if (found)
        value = found->get<bool>();
}

void SettingsReader::choice(const char* name, std::string& value, const std::vector<std::string>& allowed, const char*)
{
    const json* found = find(name);
    if (found && !found->is_string())
        fail(name, "one of " + choices_text(allowed), *found);
    else if (found && std::find(allowed.begin(), allowed.end(), found->get<std::string>()) == allowed.end())
        m_error = m_where + ": '" + key(name) + "' has an unknown value " + shown_json(*found) +
                  near_names(found->get<std::string>(), allowed);
    else if (found)
        value = found->get<std::string>();
}

void SettingsReader::path(const char* name, std::string& value, const char*)
{
    const json* found = find(name);
    if (found && !found->is_string())
        fail(name, "a string", *found);
    else if (found)
        value = found->get<std::string>();
}

void SettingsReader::range(const char* name, double& low, double& high, double low_limit, double high_limit,
                           const char*)
{
    const json* found = find(name);
    if (!found)
        return;
    if (!found->is_array() || found->size() != 2 || !within((*found)[0], low_limit, high_limit) ||
        !within((*found)[1], (*found)[0].get<double>(), high_limit)) {
        fail(name, "two numbers, the lower one first, from " + interval_text(low_limit, high_limit), *found);
        return;
    }
    low = (*found)[0].get<double>();
    high = (*found)[1].get<double>();
}

Status SettingsReader::finish()
{
    for (const auto& [key, value] : m_values.items())
        if (m_error.empty() && std::find(m_known.begin(), m_known.end(), key) == m_known.end())
            m_error = m_where + ": unknown setting '" + shown_text(key) + "'" + near_names(key, m_known);
    return m_error.empty() ? Status() : Status(Error{ m_error });
}

SettingsWriter::SettingsWriter() : m_groups{ { "", nlohmann::ordered_json::object() } } {}

void SettingsWriter::enter(const char* group_name)
{
    m_groups.emplace_back(group_name, nlohmann::ordered_json::object());
}

void SettingsWriter::leave()
{
    const auto group = m_groups.back();
    m_groups.pop_back();
    m_groups.back().second[group.first] = group.second;
}

void SettingsWriter::number(const char* name, double& value, double, double, const char*)
{
    m_groups.back().second[name] = value;
}

void SettingsWriter::integer(const char* name, int& value, int, int, const char*)
{
    m_groups.back().second[name] = value;
}

void SettingsWriter::flag(const char* name, bool& value, const char*)
{
    m_groups.back().second[name] = value;
}

void SettingsWriter::choice(const char* name, std::string& value, const std::vector<std::string>&, const char*)
{
    m_groups.back().second[name] = value;
}

void SettingsWriter::path(const char* name, std::string& value, const char*)
{
    m_groups.back().second[name] = value;
}

void SettingsWriter::range(const char* name, double& low, double& high, double, double, const char*)
{
    m_groups.back().second[name] = { low, high };
}

void SettingsLister::number(const char* name, double& value, double low, double high, const char* text)
{
    m_rows.push_back({ key(name), number_text(value), interval_text(low, high), text });
}

void SettingsLister::integer(const char* name, int& value, int low, int high, const char* text)
{
    m_rows.push_back({ key(name), std::to_string(value), std::to_string(low) + " to " + std::to_string(high), text });
}

void SettingsLister::flag(const char* name, bool& value, const char* text)
{
    m_rows.push_back({ key(name), value ? "true" : "false", "true, false", text });
}

void SettingsLister::choice(const char* name, std::string& value, const std::vector<std::string>& allowed,
                            const char* text)
{
    m_rows.push_back({ key(name), value, choices_text(allowed), text });
}

void SettingsLister::path(const char* name, std::string& value, const char* text)
{
    m_rows.push_back({ key(name), value.empty() ? "\"\"" : value, "text", text });
}

void SettingsLister::range(const char* name, double& low, double& high, double low_limit, double high_limit,
                           const char* text)
{
    m_rows.push_back({ key(name), "[" + number_text(low) + ", " + number_text(high) + "]",
                       interval_text(low_limit, high_limit), text });
}

json flat_settings(const json& object)
{
    json values = json::object();
    flatten(object, "", values);
    return values;
}

Expected<json> parse_assignment(const std::string& assignment)
{
    const std::size_t equals = assignment.find('=');
    if (equals == 0 || equals == std::string::npos)
        return Error{ "--set " + shown_text(assignment) + ": expected key=value" };
    const std::string text = assignment.substr(equals + 1);
    Expected<json> value = parse_json<json>(text);
    if (!value)
        value = parse_json<json>("[" + text + "]");
    return json{ { assignment.substr(0, equals), value && !text.empty() ? *value : json(text) } };
}

} // namespace srisp::train
