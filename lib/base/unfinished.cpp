// SPDX-License-Identifier: Apache-2.0
#include "base/unfinished.h"

#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <random>
#include <set>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hashes.h"
#include "base/printed.h"

namespace srisp {

namespace fs = std::filesystem;

namespace {

const char kMark[] = ".partial-";
constexpr std::size_t kHalf = 8;              // hexadecimal digits
constexpr std::size_t kLongestExtension = 16; // what is longer is no extension that a writer knows
constexpr int kMostTries = 1000;

std::string digits(std::uint64_t value)
{
    return printed("%08x", static_cast<unsigned>(value & 0xffffffffu));
}

std::string name_of(const fs::path& target, std::uint32_t random)
{
    std::string stem = target.stem().string(), extension = target.extension().string();
    if (extension.size() > kLongestExtension)
        stem += std::exchange(extension, "");
    const std::string added = kMark + digits(random) + digits(seeded_hash(random, target.filename().string()));
    const std::size_t room = NAME_MAX - 1 - added.size() - extension.size();
    return "." + stem.substr(0, room) + added + extension;
}

bool is_one(int descriptor, const fs::path& path)
{
    struct stat open, named;
    return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
           open.st_ino == named.st_ino;
}

/// False: another program holds the lock. Some network file systems cannot lock; there nothing is ever removed.
bool lock(int descriptor)
{
    return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// `open`: makes and opens it, or gives -1. Between that and its lock another program may take it for a leftover; then
/// there is a next name.
Expected<Unfinished> make(const fs::path& target, const std::function<int(const std::string&)>& open)
{
    for (int tries = 0; tries < kMostTries; ++tries) {
        const std::string path = unfinished_name(target).string();
        const int descriptor = open(path);
        if (descriptor < 0) {
            if (errno == EEXIST || errno == EINTR)
                continue;
            return Error{ std::strerror(errno) };
        }
        if (lock(descriptor) && is_one(descriptor, path))
            return Unfinished{ path, descriptor };
        ::close(descriptor);
    }
    return Error{ "other programs remove what is made" };
}

Expected<Unfinished> make_file(const fs::path& target, mode_t mode)
{
    return make(target, [mode](const std::string& path) {
        return ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    });
}

} // namespace

fs::path unfinished_name(const fs::path& target)
{
    return target.parent_path() / name_of(target, std::random_device{}());
}

bool is_unfinished_name(const std::string& name, const fs::path& target)
{
    const std::size_t mark = name.rfind(kMark);
    unsigned random = 0;
    return mark != std::string::npos && std::sscanf(name.c_str() + mark + std::strlen(kMark), "%8x", &random) == 1 &&
           name == name_of(target, random);
}

Expected<Unfinished> make_unfinished_file(const fs::path& target)
{
    return make_file(target, 0666);
}

Expected<Unfinished> make_private_unfinished_file(const fs::path& target)
{
    return make_file(target, 0600);
}

Expected<Unfinished> make_unfinished_folder(const fs::path& target)
{
    return make(target, [](const std::string& path) {
        if (::mkdir(path.c_str(), 0700) != 0)
            return -1;
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (descriptor < 0 && errno == ENOENT)
            errno = EEXIST; // another program was here first
        return descriptor;
    });
}

int lock_leftover(const fs::path& path, unsigned kind)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    struct stat info;
    if (descriptor >= 0 && ::fstat(descriptor, &info) == 0 && (info.st_mode & S_IFMT) == kind &&
        info.st_uid == ::geteuid() && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_one(descriptor, path))
        return descriptor;
    if (descriptor >= 0)
        ::close(descriptor);
    return -1;
}

static fs::path folder_of(const fs::path& target)
{
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// What an unfinished file was to become, by its name.
static std::string target_name(const std::string& name)
{
    const std::size_t mark = name.rfind(kMark), rest = mark + std::strlen(kMark) + 2 * kHalf;
    return mark == std::string::npos || mark < 1 || rest > name.size() ? ""
                                                                       : name.substr(1, mark - 1) + name.substr(rest);
}

void remove_leftover_files(const fs::path& target)
{
    static std::mutex mutex;
    static std::set<std::string> seen;
    const fs::path folder = folder_of(target);
    std::error_code error;
    {
        const std::lock_guard lock(mutex);
        if (!seen.insert(fs::absolute(folder, error).string()).second)
            return;
    }
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        const std::string was_for = target_name(name);
        if (was_for.empty() || !is_unfinished_name(name, was_for))
            continue;
        if (const int descriptor = lock_leftover(entry->path(), S_IFREG); descriptor >= 0) {
            std::remove(entry->path().c_str());
            ::close(descriptor);
        }
    }
}

void for_each_leftover(const fs::path& target, const std::function<void(const fs::path&)>& remove)
{
    std::error_code error;
    const fs::path folder = folder_of(target);
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (!is_unfinished_name(entry->path().filename().string(), target))
            continue;
        for (const unsigned kind : { S_IFREG, S_IFDIR })
            if (const int descriptor = lock_leftover(entry->path(), kind); descriptor >= 0) {
                remove(entry->path());
                ::close(descriptor);
            }
    }
}

} // namespace srisp
