// SPDX-License-Identifier: Apache-2.0
#include "base/installed_files.h"

#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

namespace fs = std::filesystem;

namespace {

/// The file that this code is in; empty if it cannot be told.
fs::path own_file()
{
    Dl_info info;
    if (dladdr(reinterpret_cast<const void*>(&shared_folder), &info) == 0)
        return {};
    std::error_code error;
    // Of a program, not a library, dladdr knows only what it was called by.
    return fs::canonical(info.dli_fname[0] == '/' ? info.dli_fname : "/proc/self/exe", error);
}

/// The nearest folder above `file` that has `relative` in it, with that.
template<class Test> fs::path find_above(const fs::path& file, const fs::path& relative, const Test& test)
{
    for (fs::path folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
        if (test(folder / relative))
            return folder / relative;
    return {};
}

} // namespace

fs::path shared_folder(const std::string& name)
{
    return find_above(own_file(), fs::path("share/srisp") / name, [](const fs::path& found) {
        std::error_code error;
        return fs::is_directory(found, error);
    });
}

fs::path own_program(const std::string& name)
{
    const fs::path self = own_file();
    struct stat own {};
    if (self.empty() || ::stat(self.c_str(), &own) != 0)
        return {};
    return find_above(self, fs::path("libexec/srisp") / name, [&](const fs::path& found) {
        struct stat info {};
        return ::stat(found.c_str(), &info) == 0 && S_ISREG(info.st_mode) && (info.st_mode & S_IWOTH) == 0 &&
               (info.st_uid == own.st_uid || info.st_uid == 0 || info.st_uid == ::geteuid());
    });
}

std::string plugins_beside()
{
    const fs::path folder = own_file().parent_path() / "srisp";
    std::error_code error;
    return fs::exists(folder / "dng.imageio.so", error) ? folder.string() : "";
}

} // namespace srisp
