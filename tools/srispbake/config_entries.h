// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace srisp::tool {

/// What is added to a config: sections and their lines, indented by two. `to_reference`: linear sRGB → the config's
/// reference space, row-major.
struct ConfigEntries {
    std::vector<std::string> looks, colorspaces;
};
ConfigEntries config_entries(const std::array<double, 9>& to_reference);

/// A context variable and its default.
struct AddedVariable {
    std::string name, value;
    std::string line() const { return "  " + name + ": " + (value.empty() ? "\"\"" : value); }
};
extern const std::vector<AddedVariable> kAddedVariables;

/// Names and aliases of what is added.
extern const std::vector<std::string> kAddedLooks, kAddedColorSpaces, kAddedAliases;

} // namespace srisp::tool
