// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "command_line.h"
#include "job.h"
#include "messages.h"

namespace srisp::tool {

/// A command line for the stock oiiotool, and the files that it needs.
struct Rewritten {
    std::vector<std::string> words;           ///< without the program's name
    std::vector<JobFile> files;               ///< to be written into the temporary folder
    Subjects subjects;                        ///< of these files, for messages
    std::vector<std::string> warnings;        ///< for stderr
    std::map<std::string, std::string> notes; ///< for stderr, where oiiotool made a file of that name in the folder
};

struct RewriteOptions {
    std::string folder;         ///< the temporary folder, absolute
    std::string typed_command;  ///< the user's command line, to be recorded; "": not wanted
    bool progress = false;      ///< on stderr, once something takes long
    bool notes = false;         ///< on stderr: what was assumed or clipped
    bool allow_partial = false; ///< photos that break off are taken as far as they go
};

/// Turns each of our commands into commands that oiiotool knows. An image that is on the stack is handed over through
/// our writer and read back through our reader:
///     -o T/1.{FRAME_NUMBER}.srisp --pop -i T/1.{FRAME_NUMBER}.srisp
/// Where an image's file name stands immediately before and nothing changes how it is read, a recipe takes the name's
/// place instead, and pixels are read only when needed. The names of all other files that are read before the last of
/// our commands are replaced by recipes, too, which read them as they are: our reader knows more of what they hold than
/// oiiotool's. A frame wildcard stays in the name that takes the place, so that oiiotool finds the same frames.
/// Names of the user never stand in words that are added.
Rewritten rewrite(const std::vector<Step>& steps, const RewriteOptions& options);

} // namespace srisp::tool
