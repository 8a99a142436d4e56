// SPDX-License-Identifier: Apache-2.0
#include "reference/camera_files.h"

#include <algorithm>
#include <filesystem>

#include <glob.h>
#include <srisp/reference.h>

namespace srisp {

namespace {

namespace fs = std::filesystem;

struct Magic {
    std::size_t offset;
    std::string bytes;
    FileKind kind;
    const char* name;
};

std::string bytes(const char* text, std::size_t size)
{
    return { text, size };
}

const std::vector<Magic>& magics()
{
    using K = FileKind;
    static const std::vector<Magic> kMagics = {
        { 0, "\x76\x2f\x31\x01", K::exr, "OpenEXR" },       { 0, "FOVb", K::foveon, "X3F" },
        { 0, bytes("II*\0", 4), K::tiff, "TIFF" },          { 0, bytes("MM\0*", 4), K::tiff, "TIFF" },
        { 0, bytes("II+\0", 4), K::tiff, "BigTIFF" },       { 0, bytes("MM\0+", 4), K::tiff, "BigTIFF" },
        { 0, "\xff\xd8\xff", K::display_encoded, "JPEG" },  { 0, "\x89PNG", K::display_encoded, "PNG" },
        { 0, "GIF8", K::display_encoded, "GIF" },           { 0, "BM", K::display_encoded, "BMP" },
        { 8, "WEBP", K::display_encoded, "WebP" },          { 4, "ftyphei", K::display_encoded, "HEIC" },
        { 4, "ftyphev", K::display_encoded, "HEIC" },       { 4, "ftypmif1", K::display_encoded, "HEIF" },
        { 4, "ftypmsf1", K::display_encoded, "HEIF" },      { 4, "ftypavif", K::display_encoded, "AVIF" },
        { 4, "jP  \r\n", K::display_encoded, "JPEG 2000" }, { 0, "\xff\x4f\xff\x51", K::display_encoded, "JPEG 2000" },
        { 4, "JXL \r\n", K::display_encoded, "JPEG XL" },   { 0, "\xff\x0a", K::display_encoded, "JPEG XL" },
        { 0, "8BPS", K::display_encoded, "Photoshop" },     { 0, "#?RADIANCE", K::display_encoded, "Radiance HDR" },
        { 0, "SDPX", K::display_encoded, "DPX" },           { 0, "XPDS", K::display_encoded, "DPX" },
        { 0, "P5\n", K::display_encoded, "PGM" },           { 0, "P6\n", K::display_encoded, "PPM" },
    };
    return kMagics;
}

/// Sorted for binary search.
const std::vector<std::string> kRawExtensions = { "3fr", "arw", "cap", "cr2", "cr3", "crw", "dcr", "dcs",
                                                  "dng", "erf", "fff", "iiq", "k25", "kdc", "mef", "mos",
                                                  "mrw", "nef", "nrw", "orf", "pef", "qtk", "raf", "raw",
                                                  "rw2", "rwl", "rwz", "sr2", "srf", "srw", "x3f" };

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

Expected<std::vector<std::string>> files_of_one(const std::string& pattern)
{
    std::error_code ignored;
    if (fs::is_directory(pattern, ignored))
        return files_of_folder(pattern);
    if (fs::exists(pattern, ignored) || pattern.find_first_of("*?[") == std::string::npos)
        return std::vector<std::string>{ pattern }; // a missing plain file is told when it is loaded
    return files_of_glob(pattern);
}

} // namespace

FileType file_type(const std::string& head)
{
    for (const Magic& magic : magics())
        if (head.compare(std::min(magic.offset, head.size()), magic.bytes.size(), magic.bytes) == 0)
            return { magic.kind, magic.name };
    return { FileKind::raw, "" };
}

bool has_raw_extension(const std::string& path)
{
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    return extension.size() > 1 &&
           std::binary_search(kRawExtensions.begin(), kRawExtensions.end(), extension.substr(1));
}

Expected<std::vector<std::string>> expand_reference(const std::string& pattern)
{
    std::error_code ignored;
    if (pattern.empty())
        return none(pattern, "no file, folder or pattern given");
    if (pattern.find(';') == std::string::npos || fs::exists(pattern, ignored)) {
        auto files = files_of_one(pattern);
        if (files)
            std::sort(files->begin(), files->end());
        return files;
    }
    std::vector<std::string> all;
    for (std::size_t begin = 0; begin <= pattern.size();) {
        const std::size_t end = std::min(pattern.find(';', begin), pattern.size());
        const std::string item = pattern.substr(begin, end - begin);
        begin = end + 1;
        if (item.empty())
            continue;
        auto files = files_of_one(item);
        if (!files)
            return files;
        all.insert(all.end(), files->begin(), files->end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (all.empty())
        return none(pattern, "no file in this list");
    return all;
}

} // namespace srisp
