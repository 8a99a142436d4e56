// SPDX-License-Identifier: Apache-2.0
#include "base/device_output.h"

#include <algorithm>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40; // as many as the kernel follows

/// The descriptor of this process that a name leads to, through any links: 1 for /dev/stdout. -1: none.
int own_descriptor(fs::path path)
{
    std::error_code error;
    const fs::path descriptors = fs::canonical("/proc/self/fd", error);
    for (int links = 0; !error && links < kMostLinks; ++links) {
        const fs::path folder = fs::canonical(path.has_parent_path() ? path.parent_path() : fs::path("."), error);
        const std::string name = path.filename().string();
        if (error || name.empty())
            return -1;
        if (folder == descriptors)
            return name.size() < 9 && std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; })
                       ? std::stoi(name)
                       : -1;
        path = folder / fs::read_symlink(folder / name, error);
    }
    return -1;
}

} // namespace

bool is_device_output(const std::string& path)
{
    struct stat info;
    const bool special = ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
    return special || own_descriptor(path) >= 0;
}

int open_device_output(const std::string& path)
{
    // Opened anew, a file would be written from its beginning, and a socket not at all.
    const int own = own_descriptor(path);
    return own >= 0 ? ::fcntl(own, F_DUPFD_CLOEXEC, 0) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
}

} // namespace srisp
