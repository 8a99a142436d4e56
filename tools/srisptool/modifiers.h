// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace srisp::tool {

using Modifiers = std::vector<std::pair<std::string, std::string>>;

/// The `name=value` pairs of `--command:a=b:c="d:e"`. As in oiiotool a value ends at the next colon, or is quoted by '
/// or "; unlike oiiotool, what is malformed is an error (exit 2), not ignored.
Modifiers parse_modifiers(const std::string& word);

/// Whether oiiotool would find the modifier in its own command's word.
bool has_modifier(const std::string& word, const std::string& name);

} // namespace srisp::tool
