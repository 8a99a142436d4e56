// SPDX-License-Identifier: Apache-2.0
#include "job.h"

#include <filesystem>

#include "base/near_names.h"
#include "base/regular_file.h"
#include "model/model_files.h"
#include "recipe/frame_pattern.h"
#include "recipe/noise_source.h"
#include "recipe/option_table.h"
#include "recipe/reference_pattern.h"

#include "../common/failure.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;

const char* const kWithoutReference = "-";

std::string absolute(const std::string& path)
{
    return fs::absolute(path).lexically_normal().string();
}

bool exists(const std::string& path)
{
    std::error_code error;
    return fs::exists(path, error);
}

std::string existing_file(const std::string& command, const std::string& what, const std::string& path)
{
    const std::string named = command + ": " + what + " '" + path + "' ";
    std::error_code error;
    if (is_url(path))
        fail(named + kIsUrl);
    if (fs::is_directory(path, error))
        fail(named + kIsFolder);
    if (!exists(path))
        fail(named + "does not exist");
    if (!fs::is_regular_file(path, error))
        fail(named + kIsNoRegularFile);
    return absolute(path);
}

std::string existing_model(const std::string& command, const std::string& name_or_path)
{
    const Expected<std::string> file = find_model_file(name_or_path);
    if (!file)
        fail_usage(command + ": " + file.error().message);
    // A path is passed on as such, a name as a name: the plugin finds the same file, and records the name.
    return *file == name_or_path ? existing_file(command, "model", name_or_path) : name_or_path;
}

/// The path of a file to be written, whose folder must exist.
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

nlohmann::json existing_references(const std::string& command, const std::string& text)
{
    const Expected<std::vector<std::string>> typed = split_references(text);
    if (!typed || typed->empty())
        fail_usage(command + ": the list of references '" + text + "' is empty");
    std::vector<std::string> paths;
    for (const std::string& item : *typed) {
        if (is_url(item))
            fail(command + ": reference '" + item + "' " + kIsUrl);
        if (!exists(item))
            if (const auto files = expand_references({ item }); !files || !exists(files->front()))
                fail(command + ": reference '" + item + "' does not exist");
        paths.push_back(fs::path(resolved_reference(item, fs::current_path())).lexically_normal().string());
    }
    return paths.size() == 1 && exists(paths[0]) ? nlohmann::json(paths[0]) : nlohmann::json(paths);
}

void set_modifier(nlohmann::json& job, const SrispCommand& command, const Modifier& modifier, const std::string& word)
{
    const std::string name = std::string("--") + command.name;
    const Option* const option = find_option(command.door, modifier.first);
    if (!option)
        fail_usage("'" + word + "': unknown modifier '" + modifier.first + "'" +
                   near_names(modifier.first, option_keys(command.door)));
    nlohmann::json& value = job[job_key(*option)];
    if (option->type == OptionType::model) {
        value = existing_model(name, modifier.second);
    } else if (option->type == OptionType::parameters) {
        value = existing_file(name, "parameter file", modifier.second);
    } else if (option->type == OptionType::path) {
        value = existing_file(name, option->key, modifier.second);
    } else {
        auto read = option_value(*option, modifier.second);
        if (!read)
            fail_usage(name + ": " + read.error().message);
        value = std::move(*read);
    }
}

/// What a command says beside its modifiers.
void set_argument(nlohmann::json& job, const SrispCommand& command, const std::string& name, const std::string& text)
{
    if (command.action == std::string("save")) {
        job["file"] = frame_pattern_of_file(output_path(name, text));
    } else if (command.door == kDevelop) {
        if (const Status known = text.empty() ? Status(Error{ "no colour space is named" }) : check_space(text); !known)
            fail_usage(name + ": " + known.error().message);
        job["develop"] = text;
    } else if (command.door == kNoise) {
        if (const auto source = parse_noise_source(text); !source)
            fail_usage(name + ": " + source.error().message);
        job["noise"] = text;
    } else if (text != kWithoutReference) {
        job["reference"] = existing_references(name, text);
    } else if (!job.contains("parameters")) {
        fail_usage(name + " -: without a reference it needs params=FILE");
    }
}

} // namespace

nlohmann::json job_of(const Step& step)
{
    const SrispCommand& command = *step.srisp;
    const std::string name = std::string("--") + command.name;
    nlohmann::json job = { { "format", "srisp-recipe-1" }, { "direction", command.direction } };
    for (const Modifier& modifier : parse_modifiers(step.words[0]))
        set_modifier(job, command, modifier, step.words[0]);
    if (command.argument)
        set_argument(job, command, name, step.words[1]);
    if (command.door == kMosaic && !job.contains("mosaic"))
        job["mosaic"] = "reference";
    if (command.action == std::string("sensor") || command.action == std::string("develop"))
        job["action"] = command.action;
    return job;
}

} // namespace srisp::tool
