// SPDX-License-Identifier: Apache-2.0
#include "recipe/option_table.h"

#include <algorithm>
#include <cctype>

#include "base/near_names.h"
#include "base/parsed_number.h"
#include "base/scene_linear_space.h"
#include "base/shown_text.h"
#include "recipe/brightness.h"
#include "recipe/photo_size.h"
#include "recipe/white_balance.h"

namespace srisp {

const std::vector<Option>& option_table()
{
    using T = OptionType;
    constexpr unsigned files = kRecipe | kJob, commands = kUnprocess | kProcess | kParams;
    // clang-format off
    static const std::vector<Option> table = {
        { "reference", kQuery | files, T::references, &Recipe::references, {}, "", "", "" },
        { "model", kProgram | kQuery | files | commands, T::model, &Recipe::model, {}, "", "NAME",
          "default, spatial, or the path of a .safetensors file" },
        { "params", kProgram | kQuery | kUnprocess | kProcess, T::parameters, &Recipe::parameters, {}, "", "FILE",
          "the parameters in FILE instead of chosen ones: what --srisp-params or --srisp-save-params wrote, edited or "
          "not" },
        { "parameters", files, T::parameters, &Recipe::parameters, {}, "", "", "" },
        { "input", kProgram | kQuery | files | kUnprocess | kParams, T::choice, &Recipe::input,
          { "auto", "srgb", "linear" }, "auto", "KIND",
          "what the photo's values are; auto takes float as linear, integers as sRGB" },
        { "gainmap", kProgram | kQuery | files | kUnprocess | kParams, T::choice, &Recipe::gain_map,
          { "ignore", "apply" }, "ignore", "USE",
          "apply takes the HDR picture that a phone's JPEG holds; what is brighter than white goes above 1" },
        { "precision", kProgram | kQuery | files | kUnprocess | kProcess, T::choice, &Recipe::precision,
          { "float32", "fast" }, "float32", "KIND",
          "fast is five times as fast with the model default, one and a half to nearly two times with spatial, with "
          "an error well below one code value of 10 bits" },
        { "brightness", kProgram | kQuery | files | kUnprocess | kParams, T::brightness, &Recipe::brightness, {}, "",
          "EV", "make the result that much brighter, or darker below 0; sample draws from how unsure the brightness is, "
          "by the seed and the photo's name" },
        { "hold", files | kUnprocess, T::flag, &Recipe::hold, {}, "0", "1",
          "keep the first frame's parameters over a sequence, so that nothing flickers" },
        { "seed", kProgram | kQuery | files | kUnprocess | kParams, T::number, &Recipe::seed, {}, "0", "N",
          "for the choice among several references, and of a sampled brightness" },
        { "mosaic", kProgram | kQuery | files, T::choice, &Recipe::mosaic,
          { "reference", "RGGB", "GRBG", "GBRG", "BGGR" }, "", "", "" },
        { "phase", kMosaic, T::choice, &Recipe::mosaic, { "reference", "RGGB", "GRBG", "GBRG", "BGGR" },
          "reference", "PHASE", "the filters over pixel (0, 0), its right neighbour and the two below" },
        { "levels", kProgram | kQuery | files | kMosaic, T::choice, &Recipe::levels, { "unit", "camera" }, "unit",
          "KIND", "of a mosaic's values: 0 to 1, or the codes of REF's file, black level included; without it, the codes "
          "where only integers are written" },
        { "noise", kProgram | kQuery | files, T::text, &Recipe::noise, {}, "", "", "" },
        { "profile", kProgram | kQuery | files | kNoise, T::path, &Recipe::profile, {}, "", "FILE",
          "darktable's noiseprofiles.json, for iso=N; without it, the installed one" },
        { "noise_seed", kProgram | kQuery | files, T::number, &Recipe::noise_seed, {}, "0", "", "" },
        { "seed", kNoise, T::number, &Recipe::noise_seed, {}, "0", "N",
          "with the photo's name it says which noise is added" },
        { "develop", kProgram | kQuery | files, T::space, &Recipe::develop, {}, "", "", "" },
        { "whitebalance", kProgram | kQuery | files | kDevelop, T::white_balance, &Recipe::white_balance, {}, "scene",
          "WHITE", "what becomes white: what is white in the photo (of a camera's file as-shot), reference: what was in "
          "the reference's light; or a light as KELVIN or KELVIN,TINT, or multipliers R,G,B" },
        { "exposure", kProgram | kQuery | files | kDevelop, T::exposure, &Recipe::exposure, {}, "0", "EV",
          "brighter by that much; at 0 a white at which the first channel saturates is 1" },
        { "highlights", kProgram | kQuery | files | kDevelop, T::choice, &Recipe::highlights,
          { "clip", "blend", "keep" }, "clip", "HOW",
          "of clipped highlights: clip makes them white, blend keeps their brightness, keep everything, so that they "
          "turn magenta" },
        { "allow_partial", kProgram | kQuery | files, T::flag, &Recipe::allow_partial, {}, "0", "", "" },
        { "resize", kProgram | kQuery | kRecipe, T::resize, &Recipe::resize, {}, "", "", "" },
        { "crop", kProgram | kQuery | kRecipe, T::crop, &Recipe::crop, {}, "", "", "" },
        { "isolate", kProgram | kQuery | files, T::flag, &Recipe::isolate, {}, "1", "", "" },
        { "direction", kQuery | files, T::choice, &Recipe::direction, { "reverse", "forward" }, "reverse", "", "" },
        { "lazy", kQuery, T::flag, &Recipe::lazy, {}, "0", "", "" },
        { "source", files, T::path, &Recipe::source, {}, "", "", "" },
        { "progress", files, T::flag, &Recipe::progress, {}, "0", "", "" },
        { "notes", files, T::flag, &Recipe::notes, {}, "0", "", "" },
        { "command", files, T::text, &Recipe::command, {}, "", "", "" },
        { "action", files, T::choice, &Recipe::action, { "apply", "print", "save", "read", "sensor", "develop" }, "apply", "", "" },
        { "file", kJob, T::text, &Recipe::file, {}, "", "", "" },
        { "name", kJob, T::text, &Recipe::name, {}, "", "", "" },
    };
    // clang-format on
    return table;
}

const Option* find_option(Door door, const std::string& key)
{
    for (const Option& option : option_table())
        if (option.doors & door && key == option.key)
            return &option;
    return nullptr;
}

std::vector<std::string> option_keys(Door door)
{
    std::vector<std::string> keys;
    for (const Option& option : option_table())
        if (option.doors & door)
            keys.push_back(option.key);
    return keys;
}

const char* job_key(const Option& option)
{
    for (const Option& other : option_table())
        if (other.doors & kJob && other.target == option.target)
            return other.key;
    return option.key;
}

Expected<nlohmann::json> option_value(const Option& option, const std::string& text)
{
    const std::string what = std::string(option.key) + " '" + shown_text(text) + "'";
    if (option.type == OptionType::flag) {
        if (text != "0" && text != "1")
            return Error{ what + " is neither 0 nor 1" };
        return nlohmann::json(text == "1");
    }
    if (option.type == OptionType::number) {
        const auto number = parsed_number<std::uint64_t>(text);
        if (!number)
            return Error{ what + " is not a whole number from 0 to " + std::to_string(UINT64_MAX) };
        return nlohmann::json(*number);
    }
    if (option.type == OptionType::brightness)
        if (const auto brightness = parse_brightness(text); !brightness)
            return brightness.error();
    if (option.type == OptionType::white_balance)
        if (const auto balance = parse_white_balance(text); !balance)
            return balance.error();
    if (option.type == OptionType::exposure)
        if (const auto exposure = parse_exposure(text); !exposure)
            return exposure.error();
    if (option.type == OptionType::space)
        if (const Status known = check_space(text); !known)
            return known.error();
    if (option.type == OptionType::resize || option.type == OptionType::crop)
        if (const Status size = option.type == OptionType::crop ? check_crop(text) : check_resize(text); !size)
            return size.error();
    if (option.type == OptionType::choice)
        if (const auto index = choice_index(option, text); !index)
            return index.error();
    return nlohmann::json(text);
}

Status check_space(const std::string& name)
{
    if (name.empty() || find_scene_linear_space(name))
        return {};
    std::vector<std::string> known;
    for (const SceneLinearSpace& space : scene_linear_spaces())
        known.push_back(space.name);
    return Error{ "unknown scene-linear colour space '" + shown_text(name) + "'" + near_names(name, known) };
}

Expected<std::size_t> choice_index(const Option& option, const std::string& name)
{
    const auto same = [&](const std::string& value) {
        return std::equal(value.begin(), value.end(), name.begin(), name.end(),
                          [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
    };
    const auto found = std::find_if(option.values.begin(), option.values.end(), same);
    if (found == option.values.end())
        return Error{ std::string("unknown ") + option.key + " '" + shown_text(name) + "'" +
                      near_names(name, option.values) };
    return std::size_t(found - option.values.begin());
}

} // namespace srisp
