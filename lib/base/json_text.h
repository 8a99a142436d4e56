// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

// The one door for JSON text. What comes from outside may be of any size, nested as deep as it is long (what copies and
// prints values calls itself for each level), or hold a key a million times.

namespace srisp {

constexpr int kDeepestJson = 32;                           // levels; no file of ours has more than 6
constexpr std::size_t kLargestJson = std::size_t(1) << 20; // bytes, where a reader has no limit of its own

/// The reason of parse_json where a text breaks the grammar.
constexpr char kNotJson[] = "not JSON";

/// Any value. `Json`: nlohmann::json, or ordered_json for short texts of our own (it looks a key up in linear time).
/// Errors are reasons: kNotJson; more than `most` bytes; more than kDeepestJson levels; a key twice in one object
/// (nlohmann's parser would silently keep the last); a number beyond double.
template<class Json> Expected<Json> parse_json(std::string_view text, std::size_t most = kLargestJson);

extern template Expected<nlohmann::json> parse_json(std::string_view, std::size_t);
extern template Expected<nlohmann::ordered_json> parse_json(std::string_view, std::size_t);

/// An object. Messages: "<where>: <part> is not a JSON object (line 3, column 7)", "<where>: 'x' appears twice in the
/// <part>", "<where>: <part> is nested …".
Expected<nlohmann::json> parse_json_object(std::string_view text, const std::string& where, const std::string& part,
                                           std::size_t most = kLargestJson);

/// A value for a message: as JSON, as short as shown_text makes it.
template<class Json> std::string shown_json(const Json& value);

extern template std::string shown_json(const nlohmann::json&);
extern template std::string shown_json(const nlohmann::ordered_json&);

} // namespace srisp
