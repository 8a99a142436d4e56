// SPDX-License-Identifier: Apache-2.0
#include "photo_list.h"

#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <OpenImageIO/strutil.h>

#include "../common/failure.h"
#include "../common/interrupt.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;

bool is_image_name(const fs::path& path)
{
    static const char* const kEndings[] = { ".jpg",  ".jpeg", ".png",  ".tif", ".tiff", ".exr", ".webp",
                                            ".heic", ".heif", ".avif", ".jp2", ".bmp",  ".tga", ".ppm",
                                            ".pgm",  ".gif",  ".hdr",  ".psd", ".dpx" };
    const std::string ending = OIIO::Strutil::lower(path.extension().string());
    return std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
}

bool fits(const fs::path& path, const std::string& glob)
{
    return fnmatch(glob.c_str(), path.filename().c_str(), 0) == 0;
}

/// Adds the files of a folder and all folders in it that `is_wanted` takes, but for what is in the folder `output`.
/// Hidden files are not looked at: some are outputs that other programs are writing.
template<class IsWanted> void add_files(const std::string& folder, const std::string& output, const IsWanted& is_wanted,
                                        std::vector<Photo>& files)
{
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::follow_directory_symlink, error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
        check_interrupt();
        std::error_code ignored;
        if (!output.empty() && at->is_directory(ignored) && fs::equivalent(at->path(), output, ignored))
            at.disable_recursion_pending();
        if (at->path().filename().string()[0] != '.' && is_wanted(at->path()) && at->is_regular_file(ignored))
            files.push_back({ at->path().string(), at->path().lexically_relative(folder).string() });
    }
    if (error)
        fail("folder '" + folder + "' cannot be listed: " + error.message());
}

class PhotoList {
public:
    PhotoList(const std::string& match, const std::string& output) : m_match(match), m_output(output) {}

    void add_word(const std::string& word)
    {
        std::error_code error;
        if (word == "-")
            add_lines(std::cin, "-");
        else if (word.size() > 1 && word[0] == '@' && !fs::exists(word, error))
            add_list(word.substr(1));
        else if (fs::is_directory(word, error))
            add_folder(word);
        else if (fs::exists(word, error))
            add_file(word);
        else
            add_glob(word);
    }

    std::vector<Photo> take()
    {
        std::sort(m_photos.begin(), m_photos.end());
        const auto same = [](const Photo& a, const Photo& b) { return a.name == b.name && a.path == b.path; };
        m_photos.erase(std::unique(m_photos.begin(), m_photos.end(), same), m_photos.end());
        for (std::size_t i = 1; i < m_photos.size(); ++i)
            if (m_photos[i].name == m_photos[i - 1].name)
                fail_usage("'" + m_photos[i - 1].path + "' and '" + m_photos[i].path + "' would both be '" +
                           m_photos[i].name + "' in the output folder");
        return std::move(m_photos);
    }

private:
    void add_folder(const std::string& folder)
    {
        const std::size_t before = m_photos.size();
        add_files(
            folder, m_output,
            [&](const fs::path& path) { return m_match.empty() ? is_image_name(path) : fits(path, m_match); },
            m_photos);
        if (m_photos.size() == before)
            fail("folder '" + folder + "' holds no " +
                 (m_match.empty() ? "images" : "file that fits '" + m_match + "'"));
    }

    /// A relative path keeps its folders, unless they lead out.
    void add_file(const std::string& path)
    {
        const fs::path plain = fs::path(path).lexically_normal();
        const bool leads_out = plain.is_absolute() || *plain.begin() == "..";
        m_photos.push_back({ path, leads_out ? plain.filename().string() : plain.string() });
    }

    void add_glob(const std::string& pattern)
    {
        glob_t found{};
        const int failed = ::glob(pattern.c_str(), 0, nullptr, &found);
        for (std::size_t i = 0; !failed && i < found.gl_pathc; ++i)
            add_file(found.gl_pathv[i]);
        ::globfree(&found);
        if (failed)
            fail("photo '" + pattern + "' does not exist");
    }

    void add_list(const std::string& path)
    {
        std::ifstream lines(path);
        if (!lines)
            fail("list '" + path + "' cannot be read");
        add_lines(lines, path);
    }

    void add_lines(std::istream& lines, const std::string& where)
    {
        std::size_t count = 0;
        for (std::string line; std::getline(lines, line);) {
            if (!line.empty() && line.back() == '\r')
                line.pop_back();
            if (line.empty())
                continue;
            ++count;
            std::error_code error; // one that is missing is a photo that fails, later: others should not wait for it
            if (fs::is_directory(line, error))
                add_folder(line);
            else
                add_file(line);
        }
        if (count == 0)
            fail("list '" + where + "' names no photos");
    }

    std::string m_match, m_output;
    std::vector<Photo> m_photos;
};

} // namespace

std::vector<Photo> list_photos(const std::vector<std::string>& words, const std::string& match,
                               const std::string& output)
{
    PhotoList list(match, output);
    for (const std::string& word : words)
        list.add_word(word);
    return list.take();
}

std::vector<Photo> list_companions(const std::vector<std::string>& words, const std::vector<std::string>& globs,
                                   const std::string& output)
{
    std::vector<Photo> files;
    bool folders = false;
    for (const std::string& word : words) {
        std::error_code error;
        if (!fs::is_directory(word, error))
            continue;
        folders = true;
        add_files(
            word, output,
            [&](const fs::path& path) {
                return std::any_of(globs.begin(), globs.end(), [&](const auto& glob) { return fits(path, glob); });
            },
            files);
    }
    if (!folders)
        fail_usage("--copy takes files of folders, and the photos are not given by folders");
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace srisp::tool
