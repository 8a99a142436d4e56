// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "recipe/recipe.h"

namespace srisp {

/// Where options are given; each place takes some of them.
enum Door : unsigned {
    kNoDoor = 0,
    kProgram = 1,    ///< set_option of <srisp/options.h>
    kQuery = 2,      ///< a query, or a host's configuration hint
    kRecipe = 4,     ///< a `.srisp` file
    kJob = 8,        ///< what srisptool writes for the plugin
    kUnprocess = 16, ///< modifiers of srisptool's commands
    kProcess = 32,
    kParams = 64,
    kMosaic = 128,
    kNoise = 256,
    kDevelop = 512,
    kCommands = kUnprocess | kProcess | kParams | kMosaic | kNoise | kDevelop
};

/// How an option's value is read.
enum class OptionType {
    text,
    path,       ///< of a file; relative to the recipe's folder
    model,      ///< a name, or a path
    references, ///< a list of files, folders and globs
    parameters, ///< the path of a JSON file, or an object in a recipe
    choice,     ///< one of the option's values
    flag,       ///< true or false; 0 or 1 in a text
    number,     ///< whole, of 64 bits
    brightness, ///< a number of EV, or sample
    space,      ///< a scene-linear colour space by one of its names
    resize,     ///< a size [Options::resize]
    crop,
    white_balance,
    exposure ///< a number of EV
};

using OptionTarget =
    std::variant<std::string Recipe::*, std::vector<std::string> Recipe::*, std::optional<Parameters> Recipe::*,
                 bool Recipe::*, std::uint64_t Recipe::*, Direction Recipe::*, InputEncoding Recipe::*,
                 GainMapUse Recipe::*, Precision Recipe::*, std::optional<Mosaic> Recipe::*, Levels Recipe::*,
                 Recipe::Action Recipe::*, std::optional<Brightness> Recipe::*, WhiteBalance Recipe::*,
                 double Recipe::*, Highlights Recipe::*>;

/// One option: all that recipes, queries, hints, srisptool and its help know of it.
struct Option {
    const char* key;
    unsigned doors; ///< of Door
    OptionType type;
    OptionTarget target;
    std::vector<std::string> values; ///< of a choice, in the order of its enumeration
    const char* default_value;       ///< as text; empty: nothing
    const char* argument;            ///< what help calls the value; empty where no command takes the option
    const char* help;
};

const std::vector<Option>& option_table();

/// Null: there is none that this door takes; near_names of option_keys is for the message.
const Option* find_option(Door door, const std::string& key);
std::vector<std::string> option_keys(Door door);

/// Whether a scene-linear colour space is known; empty is. The error lists near ones, or all.
Status check_space(const std::string& name);

/// What an option of a command is called in a job.
const char* job_key(const Option& option);

/// The value that a text stands for, as it would stand in a recipe. Errors: not of the option's type, or not one of its
/// values (the near ones listed). Files are not looked at.
Expected<nlohmann::json> option_value(const Option& option, const std::string& text);

/// Which of the option's values a name is, in upper or lower case; the error lists the near ones.
Expected<std::size_t> choice_index(const Option& option, const std::string& name);

} // namespace srisp
