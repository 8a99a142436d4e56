// SPDX-License-Identifier: Apache-2.0
#include "temporary_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <regex>
#include <vector>

#include "failure.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

const char kPrefix[] = "srisptool-";
const char kLock[] = "lock";

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

/// -1: the lock is held, or there is none.
int try_lock(const fs::path& folder, int flags)
{
    const int file = open((folder / kLock).c_str(), O_RDWR | O_NOFOLLOW | flags, 0600);
    if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0)
        return file;
    if (file >= 0)
        close(file);
    return -1;
}

void remove_leftover(const fs::path& folder)
{
    struct stat info;
    if (lstat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode) || info.st_uid != geteuid())
        return;
    std::error_code error;
    if (fs::exists(folder / kLock, error)) {
        const int lock = try_lock(folder, O_CLOEXEC);
        if (lock < 0)
            return;
        remove_temporary_folder(folder);
        close(lock);
    } else if (std::time(nullptr) - info.st_mtime > 60) {
        rmdir(folder.c_str()); // killed before it was locked; a younger one may be about to be
    }
}

void remove_leftovers(const fs::path& base)
{
    std::error_code error;
    for (fs::directory_iterator entry(base, error), end; !error && entry != end; entry.increment(error))
        if (std::regex_match(entry->path().filename().string(),
                             std::regex(kPrefix + std::string("[0-9]+-[0-9A-Za-z]{6}"))))
            remove_leftover(entry->path());
}

} // namespace

TemporaryFolder::TemporaryFolder()
{
    std::string reasons;
    for (const fs::path& base : candidate_folders()) {
        remove_leftovers(base);
        std::string name = (base / (kPrefix + std::to_string(getpid()) + "-XXXXXX")).string();
        if (mkdtemp(name.data())) {
            m_path = name;
            // Not close-on-exec: an oiiotool that outlives us keeps the folder locked.
            m_lock = try_lock(m_path, O_CREAT);
            if (m_lock >= 0)
                return;
        }
        reasons += "; " + base.string() + ": " + std::strerror(errno);
        std::error_code error;
        if (!m_path.empty())
            fs::remove_all(m_path, error);
        m_path.clear();
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
    std::error_code error;
    std::ifstream list(folder / kStartedOutputs, std::ios::binary);
    for (std::string path; std::getline(list, path, '\0');)
        fs::remove(path, error);
    fs::remove_all(folder, error);
}

} // namespace srisp::tool
