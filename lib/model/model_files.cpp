// SPDX-License-Identifier: Apache-2.0
#include "model/model_files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/installed_files.h"
#include "base/near_names.h"
#include "base/shown_text.h"

namespace srisp {

namespace fs = std::filesystem;

namespace {

const char kExtension[] = ".safetensors";

std::vector<fs::path> model_folders()
{
    std::vector<fs::path> folders;
    const char* variable = std::getenv("SRISP_MODEL_PATH");
    std::istringstream list(variable ? variable : "");
    for (std::string folder; std::getline(list, folder, ':');)
        if (!folder.empty())
            folders.push_back(folder);
    if (const fs::path folder = shared_folder("models"); !folder.empty())
        folders.push_back(folder);
    return folders;
}

bool has_extension(const std::string& name)
{
    return fs::path(name).extension() == kExtension;
}

} // namespace

std::string model_name_of_path(const std::string& path)
{
    return fs::path(path).stem().string();
}

std::vector<std::string> model_names()
{
    std::set<std::string> names;
    for (const fs::path& folder : model_folders()) {
        std::error_code error;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
            if (has_extension(entry.path().string()))
                names.insert(model_name_of_path(entry.path().string()));
    }
    return { names.begin(), names.end() };
}

Expected<std::string> find_model_file(const std::string& name_or_path)
{
    if (name_or_path.empty())
        return Error{ "model name is empty" };
    if (name_or_path.find('/') != std::string::npos || has_extension(name_or_path))
        return name_or_path;
    const std::vector<std::string> files = model_files_named(name_or_path);
    if (!files.empty())
        return files.front();
    return Error{ "unknown model '" + shown_text(name_or_path) + "'" + near_names(name_or_path, model_names()) + " (" +
                  model_folder_list() + ")" };
}

std::vector<std::string> model_files_named(const std::string& name)
{
    const auto is_control = [](unsigned char c) { return c < 0x20; };
    std::vector<std::string> files;
    if (name.empty() || name.find('/') != std::string::npos || has_extension(name) ||
        std::any_of(name.begin(), name.end(), is_control))
        return files;
    for (const fs::path& folder : model_folders()) {
        const fs::path path = folder / (name + kExtension);
        std::error_code error;
        if (fs::exists(path, error))
            files.push_back(path.string());
    }
    return files;
}

std::string model_folder_list()
{
    std::string list;
    for (const fs::path& folder : model_folders())
        list += (list.empty() ? "looked in " : ", ") + folder.string();
    return list.empty() ? "no model folder found; set SRISP_MODEL_PATH" : list;
}

} // namespace srisp
