// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "job.h"

namespace srisp::tool {

/// A command line for the stock oiiotool, and the files that it needs.
struct Rewritten {
    std::vector<std::string> words;    ///< without the program's name
    std::vector<JobFile> files;        ///< to be written into the temporary folder
    std::vector<std::string> warnings; ///< for stderr
};

struct RewriteOptions {
    std::string folder;        ///< the temporary folder, absolute
    std::string typed_command; ///< the user's command line, to be recorded; "": not wanted
    bool progress = false;     ///< on stderr, once something takes long
    bool notes = false;        ///< on stderr: what was assumed or clipped
};

/// Turns each of our commands into commands that oiiotool knows. An image that is on the stack is handed over through
/// our writer and read back through our reader:
///     -o T/1.{FRAME_NUMBER}.srisp --pop -i T/1.{FRAME_NUMBER}.srisp
/// Where an image's plain file name stands immediately before and nothing changes how it is read, a recipe takes the
/// name's place instead, and pixels are read only when needed. Names of the user never stand in words that are added.
Rewritten rewrite(const std::vector<Step>& steps, const RewriteOptions& options);

} // namespace srisp::tool
