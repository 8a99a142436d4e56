// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace srisp::tool {

/// A file of a set.
struct ListedFile {
    std::string path;
    std::string name; ///< relative to the folder that was given, or its base name
    bool operator<(const ListedFile& other) const { return name < other.name; }
};

/// What is looked for in folders, and what it is called in messages.
struct FileKind {
    std::string one, several;                                 ///< "photo", "images"
    std::function<bool(const std::filesystem::path&)> is_one; ///< by the name of a file
};

/// Whether a path that is relative to a folder is absolute all the same, or climbs out of it.
bool leads_out(const std::string& path);

/// Images, by the endings of their names.
const FileKind& photo_files();

/// What the words of a command line name: files; folders, with all folders in them (files of that kind, or what
/// `match` fits); globs; "@file", a list with a name on each line; "-", such a list on stdin. What lies in the folder
/// `output` is left out of folders. Sorted by name. Names in a list are relative to the working folder; those that are
/// relative keep their folders. Throws Failure: nothing is found; a list that cannot be read; two files of one name.
std::vector<ListedFile> list_files(const std::vector<std::string>& words, const FileKind& kind,
                                   const std::string& match = "", const std::string& output = "");

/// Other files in those folders that are given by their names: those that fit one of the globs. Sorted by name. Throws
/// Failure: there are no such folders.
std::vector<ListedFile> list_companions(const std::vector<std::string>& words, const std::vector<std::string>& globs,
                                        const std::string& output);

} // namespace srisp::tool
