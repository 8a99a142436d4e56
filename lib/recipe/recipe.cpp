// SPDX-License-Identifier: Apache-2.0
#include "recipe/recipe.h"

#include <climits>
#include <filesystem>
#include <type_traits>

#include "base/guarded.h"
#include "base/input_file.h"
#include "base/json_text.h"
#include "base/near_names.h"
#include "base/regular_file.h"
#include "base/shown_text.h"
#include "recipe/brightness.h"
#include "recipe/option_table.h"
#include "recipe/photo_size.h"
#include "recipe/reference_pattern.h"
#include "recipe/white_balance.h"

namespace srisp {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const char kFormat[] = "srisp-recipe-1";

/// The file that an option stands in; empty for a text that a user typed.
struct Place {
    std::string file;
    std::string folder() const { return fs::path(file).parent_path().string(); }
};

std::string resolved(const std::string& path, const Place& place)
{
    return path.empty() || place.folder().empty() ? path : (fs::path(place.folder()) / path).string();
}

/// Whether a text can be the path of a file at all; it may be any string of a stranger's.
Status check_path(const std::string& path)
{
    if (is_url(path))
        return Error{ "'" + shown_text(path) + "' " + kIsUrl };
    if (path.size() >= PATH_MAX)
        return Error{ "has a path of " + std::to_string(path.size()) + " bytes, limit " +
                      std::to_string(PATH_MAX - 1) };
    if (path.find('\0') != std::string::npos)
        return Error{ "'" + shown_text(path) + "' is no path: it holds a zero byte" };
    return {};
}

Status take(std::string& target, const Option& option, const json& value, const Place& place)
{
    if (!value.is_string())
        return Error{ "must be a string" };
    target = value.get<std::string>();
    if (option.type == OptionType::space)
        return check_space(target);
    if (option.type == OptionType::resize)
        return check_resize(target);
    if (option.type == OptionType::crop)
        return check_crop(target);
    // A model is a name unless it looks like a path [Model::load].
    const bool is_path = option.type == OptionType::path ||
                         (option.type == OptionType::model &&
                          (target.find('/') != std::string::npos || fs::path(target).extension() == ".safetensors"));
    if (!is_path)
        return {};
    const Status possible = check_path(target);
    if (possible)
        target = resolved(target, place);
    return possible;
}

/// A text may be a list; in an array each path stands by itself.
Status take(std::vector<std::string>& references, const Option&, const json& value, const Place& place)
{
    std::vector<std::string> items;
    if (value.is_string()) {
        auto list = split_references(value.get<std::string>(), place.folder());
        if (!list)
            return list.error();
        items = std::move(*list);
    } else {
        for (const json& path : value.is_array() ? value : json::array({ value })) {
            if (!path.is_string())
                return Error{ "must be a path or a list of paths" };
            items.push_back(path.get<std::string>());
        }
    }
    references.clear();
    for (const std::string& item : items) {
        if (const Status possible = check_path(item); !possible)
            return possible;
        references.push_back(resolved_reference(item, place.folder()));
    }
    return {};
}

Status take(std::optional<Parameters>& target, const Option&, const json& value, const Place& place)
{
    std::string text = value.dump(), where = place.file;
    if (value.is_string()) {
        if (const Status possible = check_path(value.get<std::string>()); !possible)
            return possible;
        where = resolved(value.get<std::string>(), place);
        auto read = read_text_file(where, kLargestJson);
        if (!read)
            return Error{ "parameters " + read.error().message };
        text = std::move(*read);
    } else if (!value.is_object()) {
        return Error{ "must be an object or a path" };
    }
    auto parameters = parameters_from_json(text, "'" + where + "'");
    if (!parameters)
        return parameters.error();
    target = std::move(*parameters);
    return {};
}

Status take(bool& target, const Option&, const json& value, const Place&)
{
    if (!value.is_boolean())
        return Error{ "must be true or false" };
    target = value.get<bool>();
    return {};
}

Status take(std::uint64_t& target, const Option&, const json& value, const Place&)
{
    if (!value.is_number_unsigned())
        return Error{ "must be a whole number from 0 to " + std::to_string(UINT64_MAX) };
    target = value.get<std::uint64_t>();
    return {};
}

template<class Choice, class = std::enable_if_t<std::is_enum_v<Choice>>>
Status take(Choice& target, const Option& option, const json& value, const Place&)
{
    if (!value.is_string())
        return Error{ "must be a string" };
    const auto index = choice_index(option, value.get<std::string>());
    if (!index)
        return index.error();
    target = static_cast<Choice>(*index);
    return {};
}

Status take(std::optional<Mosaic>& target, const Option& option, const json& value, const Place& place)
{
    Mosaic mosaic{};
    const Status taken = take(mosaic, option, value, place);
    if (taken)
        target = mosaic;
    return taken;
}

/// A number, or a text of one kind that `parse` reads.
template<class Value, class Parse>
Status take_parsed(Value& target, const json& value, const char* kind, const Parse& parse)
{
    if (!value.is_string() && !value.is_number())
        return Error{ std::string("must be ") + kind };
    const auto parsed = parse(value.is_string() ? value.get<std::string>() : value.dump());
    if (!parsed)
        return parsed.error();
    target = *parsed;
    return {};
}

Status take(std::optional<Brightness>& target, const Option&, const json& value, const Place&)
{
    return take_parsed(target, value, "a number of EV or \"sample\"", parse_brightness);
}

Status take(WhiteBalance& target, const Option&, const json& value, const Place&)
{
    return take_parsed(target, value, "a temperature or a string", parse_white_balance);
}

Status take(double& target, const Option&, const json& value, const Place&)
{
    return take_parsed(target, value, "a number of EV", parse_exposure);
}

Status set_value(Recipe& recipe, const Option& option, const json& value, const Place& place)
{
    return std::visit([&](auto member) { return take(recipe.*member, option, value, place); }, option.target);
}

Status set_text(Recipe& recipe, Door door, const std::string& key, const std::string& text)
{
    const Option* const option = find_option(door, key);
    if (!option)
        return Error{ "unknown option '" + shown_text(key) + "'" + near_names(key, option_keys(door)) };
    const auto value = option_value(*option, text);
    return value ? set_value(recipe, *option, *value, {}) : value.error();
}

Status check_format(const json& object)
{
    if (!object.contains("format"))
        return Error{ "has no 'format'; this program reads " + std::string(kFormat) };
    const json& format = object["format"];
    if (!format.is_string())
        return Error{ "'format': must be a string" };
    return format == kFormat
               ? Status()
               : Error{ "'format': '" + shown_text(format.get<std::string>()) + "' is not " + std::string(kFormat) };
}

} // namespace

Expected<Recipe> recipe_from_json(const std::string& text, const std::string& path, bool is_job)
{
    const std::string where = (is_job ? "job '" : "recipe '") + path + "'";
    const Door door = is_job ? kJob : kRecipe;
    const auto parsed = parse_json<json>(text);
    if (!parsed && parsed.error().message != kNotJson)
        return Error{ where + ": " + parsed.error().message };
    if (!parsed || !parsed->is_object())
        return Error{ where + ": is not a JSON object" };
    const json& object = *parsed;
    Recipe recipe;
    recipe.path = path;
    for (const auto& [key, value] : object.items()) {
        if (key == "format")
            continue;
        const Option* const option = find_option(door, key);
        if (!option) {
            std::vector<std::string> known = option_keys(door);
            known.push_back("format");
            return Error{ where + ": unknown key '" + shown_text(key) + "'" + near_names(key, known) };
        }
        if (const Status taken = set_value(recipe, *option, value, { path }); !taken)
            return Error{ where + ": '" + key + "': " + taken.error().message };
    }
    if (const Status format = check_format(object); !format)
        return Error{ where + ": " + format.error().message };
    if (!is_job && (recipe.action == Recipe::Action::print || recipe.action == Recipe::Action::save))
        return Error{ where + ": 'action': a recipe can apply, read, sensor or develop" };
    if (!is_job && recipe.source.empty())
        return Error{ where + ": has no 'source'" };
    return recipe;
}

Status set_by_text(Recipe& recipe, const std::string& key, const std::string& value)
{
    return set_text(recipe, kQuery, key, value);
}

Status set_option(Options& options, const std::string& key, const std::string& value)
{
    return guarded("option", key, [&]() -> Status {
        Recipe recipe;
        static_cast<Options&>(recipe) = options;
        Status set = set_text(recipe, kProgram, key, value);
        if (set)
            options = std::move(static_cast<Options&>(recipe));
        return set;
    });
}

void take_as_development(Recipe& recipe)
{
    const bool unprocesses = !recipe.references.empty() || recipe.parameters;
    if (recipe.action == Recipe::Action::apply && !unprocesses && !recipe.develop.empty())
        recipe.action = Recipe::Action::develop;
}

Status check_complete(const Recipe& recipe, const std::string& where)
{
    if (recipe.action == Recipe::Action::save && recipe.file.empty())
        return Error{ where + ": has no 'file' to save parameters to" };
    const bool selects = recipe.action == Recipe::Action::apply || recipe.action == Recipe::Action::print;
    const bool senses = recipe.mosaic || !recipe.noise.empty();
    if (recipe.direction == Direction::forward && senses)
        return Error{ where + ": mosaic and noise are for RAW-like images, not for processed ones" };
    if (recipe.brightness && (recipe.direction == Direction::forward || !selects))
        return Error{ where + ": brightness is for photos that become RAW-like images" };
    if (recipe.direction == Direction::forward && !recipe.develop.empty())
        return Error{ where + ": RAW-like images are developed, not processed ones" };
    if (recipe.mosaic && !recipe.develop.empty())
        return Error{ where + ": a mosaic is not developed" };
    if (recipe.action == Recipe::Action::develop && recipe.develop.empty())
        return Error{ where + ": names no colour space to develop into" };
    if (recipe.action == Recipe::Action::sensor && !senses)
        return Error{ where + ": names neither mosaic nor noise" };
    if (selects && recipe.direction == Direction::reverse && recipe.references.empty() && !recipe.reference &&
        !recipe.parameters)
        return Error{ where + ": names no reference (a RAW file) and no parameters" };
    return {};
}

} // namespace srisp
