// SPDX-License-Identifier: Apache-2.0
#include "base/installed_files.h"

#include <dlfcn.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

namespace fs = std::filesystem;

namespace {

/// The file that this code is in; empty if it cannot be told.
fs::path find_own_file()
{
    Dl_info info;
    link_map* loaded = nullptr;
    if (dladdr1(reinterpret_cast<const void*>(&shared_folder), &info, reinterpret_cast<void**>(&loaded),
                RTLD_DL_LINKMAP) == 0)
        return {};
    std::error_code error;
    // A program has no name there, a library the path by which it was loaded.
    return fs::canonical(loaded->l_name[0] ? loaded->l_name : "/proc/self/exe", error);
}

/// At loading, since that path may be a relative one.
const fs::path& own_file()
{
    static const fs::path& file = *new fs::path(find_own_file()); // for threads that outlive other statics
    return file;
}
[[maybe_unused]] const fs::path& found_at_loading = own_file();

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
