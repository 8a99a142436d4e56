// SPDX-License-Identifier: Apache-2.0
#include "base/staged_folder.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

namespace fs = std::filesystem;

namespace {

Error failure(const std::string& path, const std::string& why)
{
    return Error{ "'" + path + "' " + why };
}

/// An open, locked folder; -1 if another program holds the lock, or there is no such folder.
int lock_folder(const std::string& path)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
        return descriptor;
    if (descriptor >= 0)
        ::close(descriptor);
    return -1;
}

std::string staging_prefix(const fs::path& target)
{
    return "." + target.filename().string() + ".partial-";
}

/// Folders that killed programs left: nobody holds their lock.
void remove_leftovers(const fs::path& target)
{
    const std::string prefix = staging_prefix(target);
    std::error_code error, ignored;
    for (fs::directory_iterator entry(target.parent_path(), error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().filename().string().compare(0, prefix.size(), prefix) != 0)
            continue;
        const int lock = lock_folder(entry->path().string());
        if (lock < 0)
            continue;
        fs::remove_all(entry->path(), ignored);
        ::close(lock);
    }
}

Status check_target(const fs::path& target, const std::string& marker, bool replace)
{
    std::error_code error;
    if (!fs::exists(target, error)) {
        if (fs::is_directory(target.parent_path(), error))
            return {};
        return failure(target.string(),
                       "cannot be made: the folder '" + target.parent_path().string() + "' does not exist");
    }
    if (!fs::is_directory(target, error))
        return failure(target.string(), "exists and is not a folder");
    if (fs::is_empty(target, error))
        return {};
    if (!fs::exists(target / marker, error))
        return failure(target.string(), "exists and holds no " + marker + "; it is not replaced");
    return replace ? Status() : failure(target.string(), "exists already; --replace makes it anew");
}

} // namespace

StagedFolder::StagedFolder(std::string target, std::string path, int lock)
    : m_target(std::move(target)), m_path(std::move(path)), m_lock(lock)
{
}

StagedFolder::~StagedFolder()
{
    std::error_code ignored;
    if (!m_path.empty())
        fs::remove_all(m_path, ignored);
    ::close(m_lock);
}

Expected<std::unique_ptr<StagedFolder>> StagedFolder::create(const std::string& name, const std::string& marker,
                                                             bool replace)
{
    std::error_code error;
    fs::path target = fs::weakly_canonical(fs::absolute(name, error) / "", error);
    if (error)
        return failure(name, "cannot be made: " + error.message());
    if (!target.has_filename())
        target = target.parent_path(); // "pack/" is "pack"
    if (Status status = check_target(target, marker, replace); !status)
        return status.error();
    remove_leftovers(target);
    std::string path = (target.parent_path() / (staging_prefix(target) + "XXXXXX")).string();
    if (!::mkdtemp(path.data()))
        return failure(target.string(), std::string("cannot be made: ") + std::strerror(errno));
    const int lock = lock_folder(path);
    if (lock < 0) {
        ::rmdir(path.c_str());
        return failure(path, std::string("cannot be locked: ") + std::strerror(errno));
    }
    return std::unique_ptr<StagedFolder>(new StagedFolder(target.string(), std::move(path), lock));
}

Status StagedFolder::publish()
{
    // mkdtemp's folder is for its owner only; this one shall be as others that the user makes.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (::chmod(m_path.c_str(), 0777 & ~mask) != 0 || ::fsync(m_lock) != 0)
        return failure(m_path, std::string("cannot be completed: ") + std::strerror(errno));
    // An empty folder is replaced by rename itself.
    if (::rename(m_path.c_str(), m_target.c_str()) == 0) {
        m_path.clear();
        return {};
    }
    if (errno != ENOTEMPTY && errno != EEXIST)
        return failure(m_target, std::string("cannot be made: ") + std::strerror(errno));
    // At no moment is there none, or half of one; the destructor removes the old one.
    if (::renameat2(AT_FDCWD, m_path.c_str(), AT_FDCWD, m_target.c_str(), RENAME_EXCHANGE) != 0)
        return failure(m_target, std::string("cannot be replaced: ") + std::strerror(errno));
    return {};
}

} // namespace srisp
