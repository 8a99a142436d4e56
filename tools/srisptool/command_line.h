// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command_table.h"
#include "recipe/option_table.h"

namespace srisp::tool {

/// What becomes of the image at one of our commands.
enum class Effect {
    replaces, ///< the result takes the image's place
    reports,  ///< the image stays
    helps,    ///< for the command line: no image
    configures
};

/// A command that srisptool adds to oiiotool's.
struct SrispCommand {
    const char* name;     ///< without dashes
    const char* argument; ///< what its one argument is called in messages; null: it takes none
    Door door;            ///< whose options are its modifiers
    Effect effect;
    const char* direction; ///< of the job: "reverse", "forward"
    const char* action;    ///< of the job: "apply", "print", "save"
    const char* help;
};

const std::vector<SrispCommand>& srisp_commands();

/// The entry of a word such as `--srisp-unprocess:model=pointwise`; null if the word is none of ours. Fails (exit 2)
/// for unknown commands that begin with --srisp.
const SrispCommand* find_srisp_command(const std::string& word);

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

} // namespace srisp::tool
