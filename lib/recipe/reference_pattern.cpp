// SPDX-License-Identifier: Apache-2.0
#include "recipe/reference_pattern.h"

#include <algorithm>
#include <climits>
#include <filesystem>
#include <string_view>

#include <glob.h>

#include "base/regular_file.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

namespace fs = std::filesystem;

/// Sorted for binary search.
const std::vector<std::string> kRawExtensions = { "3fr", "arw", "cap", "cr2", "cr3", "crw", "dcr", "dcs",
                                                  "dng", "erf", "fff", "gpr", "iiq", "k25", "kdc", "mef",
                                                  "mos", "mrw", "nef", "nrw", "orf", "pef", "qtk", "raf",
                                                  "raw", "rw2", "rwl", "rwz", "sr2", "srf", "srw", "x3f" };
const char kGlobCharacters[] = "*?[";
constexpr std::size_t kLongestList = 1 << 18; // bytes

bool exists(const std::string& path)
{
    std::error_code ignored;
    return fs::exists(path, ignored);
}

bool is_file(const fs::path& path)
{
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

Error none(const std::string& pattern, const std::string& what)
{
    return Error{ "reference '" + pattern + "': " + what };
}

Expected<std::vector<std::string>> files_of_folder(const std::string& folder)
{
    std::vector<std::string> files;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
        if (has_raw_extension(entry->path().string()) && is_file(entry->path()))
            files.push_back(entry->path().string());
    if (failed)
        return none(folder, "can't list this folder: " + failed.message());
    if (files.empty())
        return none(folder, "this folder holds no RAW files");
    return files;
}

Expected<std::vector<std::string>> files_of_glob(const std::string& pattern)
{
    std::vector<std::string> files;
    glob_t found{};
    if (::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
        for (std::size_t i = 0; i < found.gl_pathc; ++i)
            if (is_file(found.gl_pathv[i]))
                files.push_back(found.gl_pathv[i]);
    ::globfree(&found);
    if (files.empty())
        return none(pattern, "no file matches");
    return files;
}

Expected<std::vector<std::string>> files_of_item(const std::string& item)
{
    std::error_code ignored;
    if (fs::is_directory(item, ignored))
        return files_of_folder(item);
    if (exists(item) || item.find_first_of(kGlobCharacters) == std::string::npos)
        return std::vector<std::string>{ item };
    return files_of_glob(item);
}

/// The longest beginning of a list, up to a ';' or its end, that exists; else what stands before the first ';'. Each is
/// looked for on disk, so a name in a longer list may hold only so many ';'.
std::string first_item(const std::string_view list, const std::string& folder)
{
    constexpr std::size_t kMostParts = 32;
    const auto exists_to = [&](std::size_t end) {
        return end < PATH_MAX && exists(resolved_reference(std::string(list.substr(0, end)), folder));
    };
    if (exists_to(list.size()))
        return std::string(list);
    std::size_t ends[kMostParts], count = 0;
    for (std::size_t end = list.find(';'); end < PATH_MAX && count < kMostParts; end = list.find(';', end + 1))
        ends[count++] = end;
    while (count > 0)
        if (const std::size_t end = ends[--count]; end > 0 && exists_to(end))
            return std::string(list.substr(0, end));
    return std::string(list.substr(0, list.find(';')));
}

} // namespace

std::string resolved_reference(const std::string& item, const std::string& folder)
{
    if (folder.empty() || item.empty() || item[0] == '/')
        return item;
    const std::string path = (fs::path(folder) / item).string();
    if (exists(path) || item.find_first_of(kGlobCharacters) == std::string::npos)
        return path;
    std::string literal;
    for (const char c : folder)
        literal += std::string("*?[\\").find(c) == std::string::npos ? std::string(1, c) : std::string("\\") + c;
    return (fs::path(literal) / item).string();
}

Expected<std::vector<std::string>> split_references(const std::string& list, const std::string& folder)
{
    std::vector<std::string> items;
    if (list.size() > kLongestList)
        return none(shown_text(list), "this list has " + std::to_string(list.size()) + " bytes, limit " +
                                          std::to_string(kLongestList) + "; a folder or a pattern is shorter");
    for (std::size_t begin = 0; begin < list.size();) {
        const std::string item = first_item(std::string_view(list).substr(begin), folder);
        begin += item.size() + 1;
        if (!item.empty())
            items.push_back(item);
    }
    if (items.empty() && !list.empty())
        return none(list, "no file in this list");
    return items;
}

Expected<std::vector<std::string>> expand_references(const std::vector<std::string>& items)
{
    if (items.empty())
        return none("", "no file, folder or pattern given");
    std::vector<std::string> all;
    for (const std::string& item : items) {
        if (is_url(item))
            return none(shown_text(item), kIsUrl);
        const auto files = files_of_item(item);
        if (!files)
            return files;
        all.insert(all.end(), files->begin(), files->end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

bool has_raw_extension(const std::string& path)
{
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    return extension.size() > 1 &&
           std::binary_search(kRawExtensions.begin(), kRawExtensions.end(), extension.substr(1));
}

std::vector<std::string> layout_paths(const std::string& path)
{
    std::vector<std::string> paths = { path + ".json" };
    if (fs::path(path).has_extension())
        paths.push_back(fs::path(path).replace_extension(".json").string());
    return paths;
}

} // namespace srisp
