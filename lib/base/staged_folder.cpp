// SPDX-License-Identifier: Apache-2.0
#include "base/staged_folder.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/unfinished.h"

namespace srisp {

namespace fs = std::filesystem;

namespace {

Error failure(const std::string& path, const std::string& why)
{
    return Error{ "'" + path + "' " + why };
}

Status check_target(const fs::path& target, const StagedFolder::Check& check, bool replace)
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
    if (const Status status = check(target.string()); !status)
        return failure(target.string(), "exists and " + status.error().message + "; it is not replaced");
    return replace ? Status() : failure(target.string(), "exists already; --replace makes it anew");
}

} // namespace

StagedFolder::StagedFolder(std::string target, Check check, bool replace, std::string path, int lock)
    : m_target(std::move(target)), m_path(std::move(path)), m_check(std::move(check)), m_replace(replace), m_lock(lock)
{
}

StagedFolder::~StagedFolder()
{
    std::error_code ignored;
    if (!m_path.empty())
        fs::remove_all(m_path, ignored);
    ::close(m_lock);
}

Expected<std::unique_ptr<StagedFolder>> StagedFolder::create(const std::string& name, const Check& check, bool replace)
{
    std::error_code error;
    fs::path target = fs::weakly_canonical(fs::absolute(name, error) / "", error);
    if (error)
        return failure(name, "cannot be made: " + error.message());
    if (!target.has_filename())
        target = target.parent_path(); // "pack/" is "pack"
    if (Status status = check_target(target, check, replace); !status)
        return status.error();
    std::error_code ignored;
    for_each_leftover(target, [&](const fs::path& leftover) { fs::remove_all(leftover, ignored); });
    const Expected<Unfinished> made = make_unfinished_folder(target);
    if (!made)
        return failure(target.string(), "cannot be made: " + made.error().message);
    return std::unique_ptr<StagedFolder>(
        new StagedFolder(target.string(), check, replace, made->path, made->descriptor));
}

Status StagedFolder::publish()
{
    // Until now it was for its owner only; it shall be as others that the user makes.
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
    if (const Status status = check_target(m_target, m_check, m_replace); !status) // others may have been at it
        return status;
    // At no moment is there none, or half of one; the destructor removes the old one.
    if (::renameat2(AT_FDCWD, m_path.c_str(), AT_FDCWD, m_target.c_str(), RENAME_EXCHANGE) != 0)
        return failure(m_target, std::string("cannot be replaced: ") + std::strerror(errno));
    return {};
}

} // namespace srisp
