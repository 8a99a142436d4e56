// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <glob.h>

#include <filesystem>
#include <sstream>

#include "model/model_files.h"

#include "../common/failure.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

std::string absolute(const std::string& path)
{
    return fs::absolute(path).lexically_normal().string();
}

bool exists(const std::string& path)
{
    std::error_code error;
    return fs::exists(path, error);
}

/// Appends what one name stands for: itself if it exists, else the files that it matches.
void expand(const std::string& command, const std::string& name, nlohmann::json& paths)
{
    if (exists(name)) {
        paths.push_back(absolute(name));
        return;
    }
    glob_t matches{};
    const bool found = name.find_first_of("*?[") != std::string::npos && glob(name.c_str(), 0, nullptr, &matches) == 0;
    for (std::size_t i = 0; found && i < matches.gl_pathc; ++i)
        paths.push_back(absolute(matches.gl_pathv[i]));
    globfree(&matches);
    if (!found)
        fail(command + ": reference '" + name + "' does not exist");
}

} // namespace

nlohmann::json reference_input(const std::string& command, const std::string& text)
{
    nlohmann::json paths = nlohmann::json::array();
    std::istringstream list(text);
    if (exists(text) || text.find(';') == std::string::npos)
        expand(command, text, paths);
    else
        for (std::string name; std::getline(list, name, ';');)
            if (!name.empty())
                expand(command, name, paths);
    if (paths.empty())
        fail_usage(command + ": the list of references '" + text + "' is empty");
    return paths.size() == 1 ? paths[0] : paths;
}

std::string file_input(const std::string& command, const std::string& what, const std::string& path)
{
    std::error_code error;
    if (fs::is_directory(path, error))
        fail(command + ": " + what + " '" + path + "' is a folder, not a file");
    if (!exists(path))
        fail(command + ": " + what + " '" + path + "' does not exist");
    return absolute(path);
}

std::string model_input(const std::string& command, const std::string& name_or_path)
{
    const Expected<std::string> file = find_model_file(name_or_path);
    if (!file)
        fail_usage(command + ": " + file.error().message);
    // A path is passed on as such, a name as a name: the plugin finds the same file, and records the name.
    return *file == name_or_path ? file_input(command, "model", name_or_path) : name_or_path;
}

std::string output_path(const std::string& command, const std::string& path)
{
    const fs::path file = absolute(path);
    std::error_code error;
    if (fs::is_directory(file, error))
        fail(command + ": '" + path + "' is a folder, not a file");
    if (!fs::is_directory(file.parent_path(), error))
        fail(command + ": the folder of '" + path + "' does not exist");
    return file.string();
}

} // namespace srisp::tool
