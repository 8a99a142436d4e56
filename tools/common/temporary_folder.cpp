// SPDX-License-Identifier: Apache-2.0
#include "temporary_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/unfinished.h"

#include "failure.h"
#include "unfinished_output.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

const char kName[] = "srisptool";
constexpr std::size_t kLongestList = 16 << 20;

/// Only characters that mean nothing to oiiotool (wildcards, expressions, queries) or to ld.so (LD_PRELOAD's
/// separators).
bool is_harmless(const std::string& path)
{
    for (const unsigned char c : path)
        if (c < 0x80 && !std::isalnum(c) && !std::strchr("/._-+", c))
            return false;
    return !path.empty() && path[0] == '/';
}

std::vector<fs::path> candidate_folders()
{
    std::vector<fs::path> folders;
    const char* variable = std::getenv("TMPDIR");
    for (const std::string& name :
         { std::string(variable ? variable : ""), std::string("/tmp"), std::string("/dev/shm") }) {
        std::error_code error;
        const fs::path folder = name.empty() ? fs::path() : fs::absolute(name, error).lexically_normal();
        if (!error && is_harmless(folder.string()) && fs::is_directory(folder, error))
            folders.push_back(folder);
    }
    return folders;
}

/// Only what a run of this user left, in a folder that was private.
void remove_leftover(const fs::path& folder)
{
    struct stat info;
    if (lstat(folder.c_str(), &info) == 0 && S_ISDIR(info.st_mode) && (info.st_mode & 07777) == 0700)
        remove_temporary_folder(folder);
}

/// The names in the list; none where it is no plain file of ours.
std::vector<std::string> listed_outputs(const fs::path& list)
{
    const int file = open(list.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    struct stat info;
    std::string text;
    if (file >= 0 && fstat(file, &info) == 0 && S_ISREG(info.st_mode) && info.st_uid == geteuid()) {
        text.resize(std::min<std::size_t>(std::size_t(info.st_size), kLongestList));
        text.resize(std::size_t(std::max<ssize_t>(read(file, text.data(), text.size()), 0)));
    }
    if (file >= 0)
        close(file);
    std::vector<std::string> names;
    for (std::size_t begin = 0, end; (end = text.find('\0', begin)) != std::string::npos; begin = end + 1)
        names.push_back(text.substr(begin, end - begin));
    return names;
}

/// Nothing but a file of this user under a name that oiiotool made.
void remove_unfinished_output(const std::string& path)
{
    struct stat info;
    if (path[0] == '/' && is_unfinished_output(path) && lstat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode) &&
        info.st_uid == geteuid())
        unlink(path.c_str());
}

} // namespace

TemporaryFolder::TemporaryFolder()
{
    std::string reasons;
    for (const fs::path& base : candidate_folders()) {
        for_each_leftover(base / kName, remove_leftover);
        if (const Expected<Unfinished> made = make_unfinished_folder(base / kName)) {
            m_path = made->path;
            m_lock = made->descriptor;
            fcntl(m_lock, F_SETFD, 0); // an oiiotool that outlives us keeps the folder locked
            return;
        } else {
            reasons += "; " + base.string() + ": " + made.error().message;
        }
    }
    fail("cannot make a temporary folder" + reasons + " (set TMPDIR to a writable folder with a plain name)");
}

TemporaryFolder::~TemporaryFolder()
{
    remove_temporary_folder(m_path);
    close(m_lock);
}

void remove_temporary_folder(const fs::path& folder)
{
    for (const std::string& output : listed_outputs(folder / kStartedOutputs))
        remove_unfinished_output(output);
    std::error_code error;
    fs::remove_all(folder, error);
}

} // namespace srisp::tool
