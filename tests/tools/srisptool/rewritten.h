// SPDX-License-Identifier: Apache-2.0
#pragma once

// Command lines as tests give them to the rewriter, and what they expect of it.

#include <string>
#include <vector>

#include "../../../tools/srisptool/rewriter.h"
#include "scratch_folder.h"

namespace srisp::tool {

using Words = std::vector<std::string>;

inline const std::string kOut = "-o:datatype=float:bits=0:autocc=0:autotrim=0:dither=0";
inline const std::string kReadNow = "-i:now=1";
inline const std::string kIn = "-i:now=1:autocc=0:info=0";

/// A photo and a reference that exist.
struct Files {
    ScratchFolder scratch;
    std::string photo = scratch.file("a.jpg"), other = scratch.file("b.jpg"), reference = scratch.file("r.dng");
};

inline Rewritten rewritten(const Words& words, const RewriteOptions& options = { "/T", "", false, false })
{
    return rewrite(parse_command_line(words), options);
}

inline Words hand_over(const std::string& number)
{
    const std::string slot = "/T/" + number + ".{FRAME_NUMBER}.srisp";
    return { kOut, slot, "--pop", kIn, slot };
}

inline Words joined(const std::vector<Words>& parts)
{
    Words all = { "--nosoftwareattrib" };
    for (const Words& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

} // namespace srisp::tool
