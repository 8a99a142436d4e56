// SPDX-License-Identifier: Apache-2.0
#include "base/recently_kept.h"

#include <sys/stat.h>

namespace srisp {

std::string file_state(const std::string& path)
{
    struct stat status;
    if (::stat(path.c_str(), &status) != 0)
        return path;
    return path + "\n" + std::to_string(status.st_dev) + " " + std::to_string(status.st_ino) + " " +
           std::to_string(status.st_size) + " " + std::to_string(status.st_mtim.tv_sec) + " " +
           std::to_string(status.st_mtim.tv_nsec);
}

} // namespace srisp
