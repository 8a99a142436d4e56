// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "container/image_file.h"
#include "result/computed_image.h"

namespace srisp::plugin {

/// A name that a host asks for, taken apart: `photo.jpg.srisp?reference=a.dng`.
struct QueryName {
    std::string file;   ///< up to and with ".srisp": a recipe or stub on disk, or the source with ".srisp" appended
    std::string source; ///< `file` without ".srisp"
    std::string query;  ///< what follows '?'
};

/// None where a name is not ours, by its form alone: ours end in ".srisp", or hold ".srisp?". Reads nothing, calls
/// nothing: OpenImageIO 2.4 holds a lock while it offers a file that nobody knows to every plugin.
std::optional<QueryName> parse_name(const std::string& name);

/// Puts the settings of a query (`key=value&…`, percent-encoded) into `recipe`. Errors: unknown keys, broken %-codes.
Status apply_query(Recipe& recipe, const std::string& query);

/// The same for a host's configuration hints `srisp:…`. Unknown ones are errors.
Status apply_hints(Recipe& recipe, const OIIO::ImageSpec& config);

/// Whether our reader answers for a name: it has our form, and what lies on disk under it (if anything) is a recipe or
/// a stub. Calls nothing of OpenImageIO's (see parse_name).
bool is_our_name(const std::string& name);

/// What a name stands for: one of the two.
struct OpenedName {
    std::unique_ptr<ComputedImage> result;
    std::unique_ptr<ImageFile> file; ///< of a recipe that only reads its source
    bool notes = false;              ///< are to be printed for `file`
};

/// Opens what a host asks for: a name with a query, a recipe, a frame of a job that has a source, a stub of the
/// hand-over, each with configuration hints.
Expected<OpenedName> open_name(const std::string& name, const OIIO::ImageSpec& config);

/// Reads the job file that a stub's path (or the temporary name of one) belongs to; sets the name in it.
Expected<Recipe> read_job(const std::string& stub_path);

} // namespace srisp::plugin
