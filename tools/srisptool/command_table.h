// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace srisp::tool {

/// What a command of oiiotool means for the rewriting.
enum class Role {
    plain,   ///< changes nothing of how images are read, needs none
    sticky,  ///< changes how later inputs are read, or prints something of each
    reads,   ///< `-i`
    creates, ///< puts a new image on the stack
    writes,  ///< `-o` and its kin
    acts     ///< needs images: oiiotool puts it off while there are too few, or runs it conditionally
};

struct OiiotoolCommand {
    const char* name; ///< without dashes
    int arguments;    ///< words that follow it
    Role role;
};

/// Every command of oiiotool 2.4, the undocumented ones too; tests hold it against `oiiotool --help`.
const std::vector<OiiotoolCommand>& oiiotool_commands();

/// The entry of a word such as `--resize:filter=box` or `-resize`; null if oiiotool 2.4 has no such command.
const OiiotoolCommand* find_oiiotool_command(const std::string& word);

/// Whether oiiotool takes the word for a command: one or two dashes and a letter.
bool is_command(const std::string& word);

/// The name in such a word: without dashes and modifiers.
std::string command_name(const std::string& word);

} // namespace srisp::tool
