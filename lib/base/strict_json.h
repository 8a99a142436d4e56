// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

namespace srisp {

/// Parses a JSON object, in which no key may appear twice (nlohmann's parser would silently keep the last). Messages:
/// "<where>: <part> is not a JSON object (line 3, column 7)", "<where>: 'x' appears twice in the <part>".
Expected<nlohmann::json> parse_json_object(const std::string& text, const std::string& where, const std::string& part);

} // namespace srisp
