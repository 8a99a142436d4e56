// SPDX-License-Identifier: Apache-2.0
#include "recipe/recipe.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

#include <nlohmann/json.hpp>

#include "base/file_bytes.h"
#include "base/near_names.h"
#include "parameters/printed_parameters.h"

namespace srisp {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMostParameters = 1 << 20; // bytes; 700 are usual

std::string resolved(const std::string& path, const fs::path& folder)
{
    return path.empty() || folder.empty() ? path : (folder / path).string();
}

/// Each part of a ';' list by itself; a file whose own name holds ';' is left whole.
std::string resolved_list(const std::string& list, const fs::path& folder)
{
    std::error_code ignored;
    const std::string whole = resolved(list, folder);
    if (fs::exists(whole, ignored))
        return whole;
    std::string result;
    for (std::size_t start = 0; start <= list.size();) {
        const std::size_t end = std::min(list.find(';', start), list.size());
        result += (start ? ";" : "") + resolved(list.substr(start, end - start), folder);
        start = end + 1;
    }
    return result;
}

Status read_parameters(Recipe& recipe, const std::string& path)
{
    auto text = read_text_file(path, kMostParameters);
    if (!text)
        return Error{ "parameters " + text.error().message };
    recipe.parameters = without_image_name(*text);
    recipe.parameters_where = "parameters '" + path + "'";
    return {};
}

Status set_direction(Recipe& recipe, const std::string& name)
{
    if (name != "reverse" && name != "forward")
        return Error{ "unknown direction '" + name + "'" + near_names(name, { "reverse", "forward" }) };
    recipe.direction = name == "reverse" ? Direction::reverse : Direction::forward;
    return {};
}

Status set_input(Recipe& recipe, const std::string& name)
{
    auto input = input_encoding_from_name(name);
    if (!input)
        return input.error();
    recipe.input = *input;
    return {};
}

Status set_precision(Recipe& recipe, const std::string& name)
{
    const auto precision = precision_from_name(name);
    if (!precision)
        return precision.error();
    recipe.precision = *precision;
    return {};
}

Status set_action(Recipe& recipe, const std::string& name)
{
    const std::map<std::string, Recipe::Action> actions = { { "apply", Recipe::Action::apply },
                                                            { "print", Recipe::Action::print },
                                                            { "save", Recipe::Action::save } };
    const auto found = actions.find(name);
    if (found == actions.end())
        return Error{ "unknown action '" + name + "'" + near_names(name, { "apply", "print", "save" }) };
    recipe.action = found->second;
    return {};
}

Status set_reference(Recipe& recipe, const std::string& pattern)
{
    recipe.reference = pattern;
    return {};
}

Status set_model(Recipe& recipe, const std::string& name)
{
    recipe.model = name;
    return {};
}

Status set_seed(Recipe& recipe, const std::string& digits)
{
    if (digits.empty() || digits.size() > 19 || digits.find_first_not_of("0123456789") != std::string::npos)
        return Error{ "seed '" + digits + "' is not a whole number from 0" };
    recipe.seed = std::stoull(digits);
    return {};
}

Status set_lazy(Recipe& recipe, const std::string& flag)
{
    if (flag != "0" && flag != "1")
        return Error{ "lazy '" + flag + "' is neither 0 nor 1" };
    recipe.lazy = flag == "1";
    return {};
}

/// What a query or a hint may set.
struct Setting {
    const char* key;
    Status (*set)(Recipe& recipe, const std::string& value);
};
const Setting kSettings[] = { { "reference", set_reference }, { "model", set_model },
                              { "params", read_parameters },  { "input", set_input },
                              { "precision", set_precision }, { "seed", set_seed },
                              { "direction", set_direction }, { "lazy", set_lazy } };

/// One key of a recipe: how its value is taken.
using Taker = std::function<Status(const json& value)>;

Taker take_text(std::function<Status(const std::string&)> use)
{
    return [use](const json& value) -> Status {
        return value.is_string() ? use(value.get<std::string>()) : Status(Error{ "must be a text" });
    };
}

Taker take_text(std::string& target)
{
    return take_text([&target](const std::string& text) {
        target = text;
        return Status();
    });
}

Taker take_flag(bool& target)
{
    return [&target](const json& value) -> Status {
        if (!value.is_boolean())
            return Error{ "must be true or false" };
        target = value.get<bool>();
        return {};
    };
}

Taker take_seed(std::uint64_t& target)
{
    return [&target](const json& value) -> Status {
        if (!value.is_number_unsigned())
            return Error{ "must be a whole number from 0" };
        target = value.get<std::uint64_t>();
        return {};
    };
}

Taker take_reference(std::string& target, const fs::path& folder)
{
    return [&target, folder](const json& value) -> Status {
        if (value.is_string()) {
            target = resolved_list(value.get<std::string>(), folder);
            return {};
        }
        if (!value.is_array())
            return Error{ "must be a path or a list of paths" };
        target.clear();
        for (const json& path : value) {
            if (!path.is_string())
                return Error{ "must be a path or a list of paths" };
            target += (target.empty() ? "" : ";") + resolved(path.get<std::string>(), folder);
        }
        return {};
    };
}

Taker take_parameters(Recipe& recipe, const fs::path& folder)
{
    return [&recipe, folder](const json& value) -> Status {
        if (value.is_string())
            return read_parameters(recipe, resolved(value.get<std::string>(), folder));
        recipe.parameters = value.dump();
        recipe.parameters_where = "parameters of '" + recipe.path + "'";
        return value.is_object() ? Status() : Status(Error{ "must be an object or a path" });
    };
}

/// A model is a name unless it looks like a path [Model::load].
std::string resolved_model(const std::string& model, const fs::path& folder)
{
    return model.find('/') == std::string::npos && fs::path(model).extension() != ".safetensors"
               ? model
               : resolved(model, folder);
}

std::map<std::string, Taker> takers(Recipe& recipe, const fs::path& folder, bool is_job)
{
    std::map<std::string, Taker> keys = {
        { "format", take_text([](const std::string& format) {
              return format == "srisp-recipe-1" ? Status() : Status(Error{ "'" + format + "' is not srisp-recipe-1" });
          }) },
        { "direction", take_text([&](const std::string& name) { return set_direction(recipe, name); }) },
        { "reference", take_reference(recipe.reference, folder) },
        { "model", take_text([&recipe, folder](const std::string& model) {
              recipe.model = resolved_model(model, folder);
              return Status();
          }) },
        { "parameters", take_parameters(recipe, folder) },
        { "input", take_text([&](const std::string& name) { return set_input(recipe, name); }) },
        { "precision", take_text([&](const std::string& name) { return set_precision(recipe, name); }) },
        { "seed", take_seed(recipe.seed) },
        { "hold", take_flag(recipe.hold) },
        { "progress", take_flag(recipe.progress) },
        { "notes", take_flag(recipe.notes) },
        { "command", take_text(recipe.command) },
    };
    if (is_job) {
        keys["action"] = take_text([&](const std::string& name) { return set_action(recipe, name); });
        keys["file"] = take_text(recipe.file);
        keys["name"] = take_text(recipe.name);
    } else {
        keys["source"] = take_text([&recipe, folder](const std::string& path) {
            recipe.source = resolved(path, folder);
            return Status();
        });
    }
    return keys;
}

} // namespace

Expected<Recipe> recipe_from_json(const std::string& text, const std::string& path, bool is_job)
{
    const std::string where = (is_job ? "job '" : "recipe '") + path + "'";
    const json object = json::parse(text, nullptr, false);
    if (!object.is_object())
        return Error{ where + ": is not a JSON object" };
    Recipe recipe;
    recipe.path = path;
    const auto keys = takers(recipe, fs::path(path).parent_path(), is_job);
    std::vector<std::string> names;
    for (const auto& key : keys)
        names.push_back(key.first);
    for (const auto& [key, value] : object.items()) {
        const auto taker = keys.find(key);
        if (taker == keys.end())
            return Error{ where + ": unknown key '" + key + "'" + near_names(key, names) };
        if (const Status taken = taker->second(value); !taken)
            return Error{ where + ": '" + key + "': " + taken.error().message };
    }
    if (!object.contains("format"))
        return Error{ where + ": has no 'format'; this program reads srisp-recipe-1" };
    if (!is_job && recipe.source.empty())
        return Error{ where + ": has no 'source'" };
    return recipe;
}

Status set_by_text(Recipe& recipe, const std::string& key, const std::string& value)
{
    for (const Setting& setting : kSettings)
        if (key == setting.key)
            return setting.set(recipe, value);
    return Error{ "unknown option '" + key + "'" + near_names(key, settable_keys()) };
}

const std::vector<std::string>& settable_keys()
{
    static const std::vector<std::string> keys = [] {
        std::vector<std::string> names;
        for (const Setting& setting : kSettings)
            names.push_back(setting.key);
        return names;
    }();
    return keys;
}

Status check_complete(const Recipe& recipe, const std::string& where)
{
    if (recipe.action == Recipe::Action::save && recipe.file.empty())
        return Error{ where + ": has no 'file' to save parameters to" };
    const bool selects = recipe.direction == Direction::reverse && recipe.action != Recipe::Action::save;
    if (selects && recipe.reference.empty() && recipe.parameters.empty())
        return Error{ where + ": names no reference (a RAW file) and no parameters" };
    return {};
}

} // namespace srisp
