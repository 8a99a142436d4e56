// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "commands.h"

namespace srisp::tool {

using Modifier = std::pair<std::string, std::string>; ///< name and value
using Modifiers = std::vector<Modifier>;

/// The `name=value` pairs of `--command:a=b:c="d:e"`. As in oiiotool a value ends at the next colon, or is quoted by '
/// or "; unlike oiiotool, what is malformed is an error (exit 2), not ignored.
Modifiers parse_modifiers(const std::string& word);

/// Whether oiiotool would find the modifier in its own command's word.
bool has_modifier(const std::string& word, const std::string& name);

/// One step of a command line: an image's name, a command of oiiotool with its arguments, or one of ours.
struct Step {
    std::vector<std::string> words;            ///< as typed
    const OiiotoolCommand* oiiotool = nullptr; ///< null for names, our commands, and commands not in the table
    const SrispCommand* srisp = nullptr;

    bool is_operand() const { return !is_command(words[0]); }
    bool is_named(const std::string& name) const { return !is_operand() && command_name(words[0]) == name; }
};

/// Splits the words (without the program's name) into steps. A command that the table does not know takes no arguments.
/// Fails (exit 2) for unknown --srisp-… commands and for ours that lack their argument.
std::vector<Step> parse_command_line(const std::vector<std::string>& words);

/// Whether a command of that name (without dashes) is among the steps.
bool contains(const std::vector<Step>& steps, const std::string& name);

/// Whether a step is one of our commands for images.
bool is_for_images(const Step& step);

/// What an operand or `-i` names; empty for other steps.
std::string name_read_by(const Step& step);

/// Behind the last step before which it matters how images are read; a loop comes back to all that it holds.
std::size_t end_of_reading(const std::vector<Step>& steps);

} // namespace srisp::tool
