// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json_text.h"

namespace srisp {

/// Takes values out of a JSON object. The first error stays; what follows it does nothing.
class JsonObjectReader {
public:
    using json = nlohmann::json;

    JsonObjectReader(const json& object, std::string where);

    const json& take(const std::string& key);
    /// The same where the key may be missing: null then.
    const json* take_optional(const std::string& key);
    std::string take_text(const std::string& key);
    float take_number(const std::string& key) { return as_number(take(key), key); }
    /// None where the key is missing.
    std::optional<float> take_optional_number(const std::string& key);
    std::vector<float> take_list(const std::string& key) { return as_list(take(key), key); }
    std::vector<std::vector<float>> take_lists(const std::string& key, std::size_t count);

    void fail(const std::string& reason);

    /// Call it last: every key that was not taken is unknown.
    Status finish();

private:
    float as_number(const json& value, const std::string& key);
    std::vector<float> as_list(const json& value, const std::string& key);

    const json& m_object;
    std::string m_where, m_error;
    std::vector<std::string> m_known;
};

} // namespace srisp
