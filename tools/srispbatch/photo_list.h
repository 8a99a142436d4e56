// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace srisp::tool {

/// A photo of a set.
struct Photo {
    std::string path;
    std::string name; ///< relative to the folder that was given, or its base name: what its results are named after
    bool operator<(const Photo& other) const { return name < other.name; }
};

/// What the words of a command line name: files; folders, with all folders in them (images by their endings, or what
/// `match` fits); globs; "@file", a list with a name on each line; "-", such a list on stdin. What lies in
/// the folder `output` is left out of folders. Sorted by name. Names in
/// a list are relative to the working folder; those that are relative keep their folders. Throws Failure: nothing is
/// found; a list that cannot be read; two files of one name.
std::vector<Photo> list_photos(const std::vector<std::string>& words, const std::string& match,
                               const std::string& output = "");

/// Other files in those folders that are given by their names: those that fit one of the globs. Sorted by name. Throws
/// Failure: there are no such folders.
std::vector<Photo> list_companions(const std::vector<std::string>& words, const std::vector<std::string>& globs,
                                   const std::string& output);

} // namespace srisp::tool
