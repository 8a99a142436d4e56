// SPDX-License-Identifier: Apache-2.0
#include "stock_oiiotool.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "../common/failure.h"
#include "../common/own_location.h"

extern char** environ;

namespace srisp::tool {

namespace fs = std::filesystem;

bool is_srisptool(const fs::path& program)
{
    std::error_code error;
    // The installed names are told apart too, or two installations on PATH would call each other for ever.
    const fs::path file = fs::canonical(program, error);
    return fs::equivalent(program, own_executable(), error) || file.filename() == "srisptool" ||
           (file.filename() == "oiiotool" && file.parent_path().filename() == "srisp");
}

fs::path find_stock_oiiotool()
{
    const char* const chosen = std::getenv("SRISP_OIIOTOOL");
    if (chosen && *chosen) {
        if (access(chosen, X_OK) != 0)
            fail("SRISP_OIIOTOOL: '" + std::string(chosen) + "' is not a program that can be run");
        if (is_srisptool(chosen))
            fail("SRISP_OIIOTOOL: '" + std::string(chosen) + "' is srisptool itself, not the stock oiiotool");
        return chosen;
    }
    const char* const variable = std::getenv("PATH");
    std::istringstream folders(variable ? variable : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path program = fs::path(folder.empty() ? "." : folder) / "oiiotool";
        std::error_code error;
        if (fs::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0 && !is_srisptool(program))
            return program;
    }
    fail("no stock oiiotool on PATH (Debian: openimageio-tools); SRISP_OIIOTOOL may name one");
}

void set_variable(std::vector<std::string>& environment, const std::string& name, const std::string& value, bool joined)
{
    for (std::string& entry : environment) {
        if (entry.rfind(name + "=", 0) != 0)
            continue;
        const std::string old = entry.substr(name.size() + 1);
        entry = name + "=" + value + (joined && !old.empty() ? ":" + old : "");
        return;
    }
    environment.push_back(name + "=" + value);
}

std::vector<std::string> environment_with_plugin(const fs::path& plugin_folder)
{
    std::vector<std::string> environment;
    for (char** entry = environ; *entry; ++entry)
        environment.push_back(*entry);
    set_variable(environment, "OIIO_LIBRARY_PATH", plugin_folder.string(), true);
    set_variable(environment, "OPENIMAGEIO_PLUGIN_PATH", plugin_folder.string(), true); // its name since 2.5
    return environment;
}

} // namespace srisp::tool
