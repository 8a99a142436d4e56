// SPDX-License-Identifier: Apache-2.0
#include "own_location.h"

#include "failure.h"

namespace srisp::tool {

namespace fs = std::filesystem;

fs::path own_executable()
{
    std::error_code error;
    const fs::path path = fs::read_symlink("/proc/self/exe", error);
    if (error)
        fail("cannot read /proc/self/exe: " + error.message());
    return path;
}

fs::path plugin_folder()
{
    // SRISP_LIBDIR is what the build was configured with; the others serve a tree that was moved or repackaged. The
    // program lies in bin/ or, copied under the name oiiotool, in libexec/srisp/.
    const std::vector<std::string> libraries = { SRISP_LIBDIR, "lib", "lib/" SRISP_MULTIARCH, "lib64" };
    const fs::path program = own_executable().parent_path();
    std::string searched;
    for (const fs::path& prefix : { program.parent_path(), program.parent_path().parent_path() }) {
        for (const std::string& library : libraries) {
            const fs::path folder = prefix / library / "srisp";
            std::error_code error;
            if (fs::exists(folder / "srisp.imageio.so", error))
                return folder;
            searched += (searched.empty() ? "" : ", ") + folder.string();
        }
    }
    fail("srisp.imageio.so is missing, this installation is incomplete (looked in " + searched + ")");
}

} // namespace srisp::tool
