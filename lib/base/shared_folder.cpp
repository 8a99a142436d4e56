// SPDX-License-Identifier: Apache-2.0
#include "base/shared_folder.h"

#include <dlfcn.h>

namespace srisp {

namespace fs = std::filesystem;

fs::path shared_folder(const std::string& name)
{
    Dl_info info;
    if (dladdr(reinterpret_cast<const void*>(&shared_folder), &info) == 0)
        return {};
    std::error_code error;
    // Of a program, not a library, dladdr knows only what it was called by.
    const fs::path file = info.dli_fname[0] == '/' ? info.dli_fname : "/proc/self/exe";
    for (fs::path folder = fs::canonical(file, error).parent_path(); folder.has_relative_path();
         folder = folder.parent_path()) {
        const fs::path found = folder / "share/srisp" / name;
        if (fs::is_directory(found, error))
            return found;
    }
    return {};
}

} // namespace srisp
