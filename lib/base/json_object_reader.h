// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

#include "base/near_names.h"

namespace srisp {

/// Takes values out of a JSON object. The first error stays; what follows it does nothing.
class JsonObjectReader {
public:
    using json = nlohmann::json;

    JsonObjectReader(const json& object, std::string where) : m_object(object), m_where(std::move(where))
    {
        if (!object.is_object())
            fail("is not a JSON object");
    }

    const json& take(const std::string& key)
    {
        static const json nothing;
        m_known.push_back(key);
        if (!m_error.empty())
            return nothing;
        const auto found = m_object.find(key);
        if (found != m_object.end())
            return *found;
        fail("has no '" + key + "'");
        return nothing;
    }

    std::string take_text(const std::string& key)
    {
        const json& value = take(key);
        if (m_error.empty() && !value.is_string())
            fail("'" + key + "' must be a text");
        return m_error.empty() ? value.get<std::string>() : std::string();
    }

    float take_number(const std::string& key) { return as_number(take(key), key); }

    std::vector<float> take_list(const std::string& key) { return as_list(take(key), key); }

    std::vector<std::vector<float>> take_lists(const std::string& key, std::size_t count)
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

    void fail(const std::string& reason)
    {
        if (m_error.empty())
            m_error = m_where + " " + reason;
    }

    /// Call it last: every key that was not taken is unknown.
    Status finish()
    {
        if (m_error.empty())
            for (const auto& [key, value] : m_object.items())
                if (std::find(m_known.begin(), m_known.end(), key) == m_known.end())
                    fail("has an unknown key '" + key + "'" + near_names(key, m_known));
        return m_error.empty() ? Status() : Status(Error{ m_error });
    }

private:
    float as_number(const json& value, const std::string& key)
    {
        if (m_error.empty() && (!value.is_number() || !std::isfinite(static_cast<float>(value.get<double>()))))
            fail("'" + key + "' must hold finite numbers, has " + value.dump());
        return m_error.empty() ? static_cast<float>(value.get<double>()) : 0;
    }

    std::vector<float> as_list(const json& value, const std::string& key)
    {
        std::vector<float> numbers;
        if (m_error.empty() && !value.is_array())
            fail("'" + key + "' must be a list of numbers");
        if (m_error.empty())
            for (const json& element : value)
                numbers.push_back(as_number(element, key));
        return numbers;
    }

    const json& m_object;
    std::string m_where, m_error;
    std::vector<std::string> m_known;
};

} // namespace srisp
