// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/expected.h>

// What a reference may be called: a file, a folder (its RAW files, not those of folders inside), a glob, or a list of
// these (`a.dng;b.dng`). A name that exists is itself, whatever characters it has.

namespace srisp {

/// The items of a list whose relative names are those of `folder` (empty: of the working folder): it is parted at each
/// ';' but those in the name of something that exists. An empty list has none. Errors: a list of nothing but ';'.
Expected<std::vector<std::string>> split_references(const std::string& list, const std::string& folder = "");

/// An item, relative to `folder` unless that is empty; the folder's own characters mean nothing in a glob.
std::string resolved_reference(const std::string& item, const std::string& folder);

/// The files that items stand for; sorted by name, each once. A plain file need not exist: that is told when it is
/// loaded. Errors: no items, a folder without RAW files, a glob that matches no file.
Expected<std::vector<std::string>> expand_references(const std::vector<std::string>& items);

/// Whether a file's extension is one of a camera's RAW formats.
bool has_raw_extension(const std::string& path);

/// Where a file may lie that describes the plain samples of another: 'plate.raw.json', 'plate.json'.
std::vector<std::string> layout_paths(const std::string& path);

} // namespace srisp
