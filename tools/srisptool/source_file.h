// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace srisp::tool {

/// A file, or the files of a sequence, that the user names as an image.
struct SourceFile {
    std::string path;                ///< absolute; of a sequence the frame pattern as printf has it
    std::string wildcard;            ///< of a sequence, as typed: `1-9@@`
    std::vector<std::string> frames; ///< the numbers of those on disk
};

/// What says how a name is to be taken, at its place in the command line.
struct NameRules {
    bool wildcards = true;   ///< not after --wildcardoff
    bool expressions = true; ///< not after --evaloff
    bool frames = false;     ///< --frames says which
};

/// None where a name is no file, or may stand for another thing: an expression, a view, a query, a recipe.
std::optional<SourceFile> find_source_file(const std::string& name, const NameRules& rules);

} // namespace srisp::tool
