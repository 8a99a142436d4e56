// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace srisp::tool {

/// The text of an OpenColorIO config, to which entries can be added without touching any other character of it: its
/// top level is a YAML map whose sections start in the first column.
class YamlSections {
public:
    explicit YamlSections(const std::string& text);

    bool has(const std::string& section) const;
    /// Adds to the end of a section, or to a new section at the end of the text. `lines`: as they would be under a key
    /// in the first column, indented by two; they get the indentation of the entries that are there. Throws Failure: a
    /// section that is written in braces or brackets.
    void append(const std::string& section, const std::vector<std::string>& lines);
    /// Gives a section that is empty or missing a value on its line.
    void set(const std::string& section, const std::string& value);
    std::string text() const;

private:
    std::size_t find(const std::string& section) const;
    std::size_t end_of(std::size_t section) const;

    std::vector<std::string> m_lines;
};

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
