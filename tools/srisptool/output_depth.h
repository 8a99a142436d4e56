// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "command_line.h"

namespace srisp::tool {

/// What a file format can hold of a linear image.
enum class Depth {
    any,     ///< float, or not known to srisptool
    sixteen, ///< integers of 16 bits at most; oiiotool would write 8 unless told
    eight    ///< 8 bits at most
};

/// By the extension of a file name, or the name of a format.
Depth deepest(const std::string& name);

/// The format that an output command (`-o` and the file's name) writes: an extension or a format's name, in lower case.
std::string output_format(const std::vector<std::string>& words);

/// Whether files of that format can hold how an image is to be turned: as OpenImageIO 2.4 writes them.
bool holds_orientation(const std::string& format);

/// For a RAW-like image 8 bits are too few, and that is what oiiotool writes where the format cannot hold float: an
/// output command that says no depth gets the deepest that its format holds. Returns a
/// warning where that is 8 bits, else nothing.
std::string choose_depth(std::vector<std::string>& words);

/// Whether outputs of steps from `first` on write integers, into which nothing below 0 goes; DNG, which has levels of
/// its own, does not count.
bool writes_integers(const std::vector<Step>& steps, std::size_t first);

/// Whether a step writes a DNG.
bool writes_dng(const Step& step);

/// Takes the options of a DNG (layout, compression, bits, a float datatype) from its output command, as attributes for
/// its writer. `depth`: what `-d` says; "": nothing.
Modifiers take_dng_options(std::vector<std::string>& words, const std::string& depth);

} // namespace srisp::tool
