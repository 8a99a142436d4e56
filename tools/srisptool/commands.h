// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "recipe/option_table.h"

// The commands of a command line: oiiotool's, and those that srisptool adds.

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

/// The entry of a word such as `--srisp-unprocess:model=spatial`; null if the word is none of ours. Fails (exit 2)
/// for unknown commands that begin with --srisp.
const SrispCommand* find_srisp_command(const std::string& word);

} // namespace srisp::tool
