// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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
    const char* name;                   ///< without dashes
    const char* argument;               ///< what its one argument is called in messages; null: it takes none
    std::vector<const char*> modifiers; ///< names it allows
    Effect effect;
    const char* direction; ///< of the job: "reverse", "forward"
    const char* action;    ///< of the job: "apply", "print", "save"
};

/// The entry of a word such as `--srisp-unprocess:model=pointwise`; null if the word is none of ours. Fails (exit 2)
/// for unknown commands that begin with --srisp.
const SrispCommand* find_srisp_command(const std::string& word);

} // namespace srisp::tool
