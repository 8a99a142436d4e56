// SPDX-License-Identifier: Apache-2.0
#include "file_list.h"

#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "failure.h"
#include "interrupt.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;

bool is_image_name(const fs::path& path)
{
    static const char* const kEndings[] = { ".jpg",  ".jpeg", ".png",  ".tif", ".tiff", ".exr", ".webp",
                                            ".heic", ".heif", ".avif", ".jp2", ".bmp",  ".tga", ".ppm",
                                            ".pgm",  ".gif",  ".hdr",  ".psd", ".dpx" };
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
}

bool fits(const fs::path& path, const std::string& glob)
{
    return fnmatch(glob.c_str(), path.filename().c_str(), 0) == 0;
}

/// Adds the files of a folder and all folders in it that `is_wanted` takes, but for what is in the folder `output`.
/// Hidden files are not looked at: some are outputs that other programs are writing.
template<class IsWanted> void add_files(const std::string& folder, const std::string& output, const IsWanted& is_wanted,
                                        std::vector<ListedFile>& files)
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

class FileList {
public:
    FileList(const FileKind& kind, const std::string& match, const std::string& output)
        : m_kind(kind), m_match(match), m_output(output)
    {
    }

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

    std::vector<ListedFile> take()
    {
        std::sort(m_files.begin(), m_files.end());
        const auto same = [](const ListedFile& a, const ListedFile& b) { return a.name == b.name && a.path == b.path; };
        m_files.erase(std::unique(m_files.begin(), m_files.end(), same), m_files.end());
        for (std::size_t i = 1; i < m_files.size(); ++i)
            if (m_files[i].name == m_files[i - 1].name)
                fail_usage("'" + m_files[i - 1].path + "' and '" + m_files[i].path + "' would both be called '" +
                           m_files[i].name + "'");
        return std::move(m_files);
    }

private:
    void add_folder(const std::string& folder)
    {
        const std::size_t before = m_files.size();
        add_files(
            folder, m_output,
            [&](const fs::path& path) { return m_match.empty() ? m_kind.is_one(path) : fits(path, m_match); }, m_files);
        if (m_files.size() == before)
            fail("folder '" + folder + "' holds no " +
                 (m_match.empty() ? m_kind.several : "file that fits '" + m_match + "'"));
    }

    /// A relative path keeps its folders, unless they lead out.
    void add_file(const std::string& path)
    {
        const fs::path plain = fs::path(path).lexically_normal();
        m_files.push_back({ path, leads_out(path) ? plain.filename().string() : plain.string() });
    }

    void add_glob(const std::string& pattern)
    {
        glob_t found{};
        const int failed = ::glob(pattern.c_str(), 0, nullptr, &found);
        for (std::size_t i = 0; !failed && i < found.gl_pathc; ++i)
            add_file(found.gl_pathv[i]);
        ::globfree(&found);
        if (failed)
            fail(m_kind.one + " '" + pattern + "' does not exist");
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
            fail("list '" + where + "' names no " + m_kind.several);
    }

    const FileKind& m_kind;
    std::string m_match, m_output;
    std::vector<ListedFile> m_files;
};

} // namespace

bool leads_out(const std::string& path)
{
    const fs::path plain = fs::path(path).lexically_normal();
    return plain.is_absolute() || (!plain.empty() && *plain.begin() == "..");
}

const FileKind& photo_files()
{
    static const FileKind kind{ "photo", "images", is_image_name };
    return kind;
}

std::vector<ListedFile> list_files(const std::vector<std::string>& words, const FileKind& kind,
                                   const std::string& match, const std::string& output)
{
    FileList list(kind, match, output);
    for (const std::string& word : words)
        list.add_word(word);
    return list.take();
}

std::vector<ListedFile> list_companions(const std::vector<std::string>& words, const std::vector<std::string>& globs,
                                        const std::string& output)
{
    std::vector<ListedFile> files;
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
