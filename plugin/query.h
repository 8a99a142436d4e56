// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "recipe/recipe.h"

namespace srisp {

/// A name that a host asks for, taken apart: `photo.jpg.srisp?reference=a.dng`.
struct QueryName {
    std::string file;   ///< up to and with ".srisp": a recipe or stub on disk, or the source with ".srisp" appended
    std::string source; ///< `file` without ".srisp"
    std::string query;  ///< what follows '?'
};

/// Whether a name is ours, by its form alone: it ends in ".srisp", or holds ".srisp?". Reads nothing, calls nothing:
/// OpenImageIO 2.4 holds a lock while it offers a file that nobody knows to every plugin.
bool parse_name(const std::string& name, QueryName& parts);

/// Puts the settings of a query (`key=value&…`, percent-encoded) into `recipe`. Errors: unknown keys, broken %-codes.
Status apply_query(Recipe& recipe, const std::string& query);

/// The same for a host's configuration hints `srisp:…`. Unknown ones are errors.
Status apply_hints(Recipe& recipe, const OIIO::ImageSpec& config);

} // namespace srisp
