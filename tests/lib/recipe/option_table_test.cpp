// SPDX-License-Identifier: Apache-2.0
#include "recipe/option_table.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

std::string value_text(const Option& option, const std::string& text)
{
    const auto value = option_value(option, text);
    return value ? value->dump() : value.error().message;
}

bool at_default(const Option& option, const Recipe& recipe)
{
    Recipe set = recipe;
    REQUIRE(set_by_text(set, option.key, option.default_value));
    return std::visit(
        [&](auto member) {
            if constexpr (std::is_same_v<decltype(member), std::optional<Parameters> Recipe::*> ||
                          std::is_same_v<decltype(member), std::optional<Brightness> Recipe::*>)
                return true;
            else if constexpr (std::is_same_v<decltype(member), WhiteBalance Recipe::*>)
                return (set.*member).kind == (recipe.*member).kind;
            else
                return set.*member == recipe.*member;
        },
        option.target);
}

} // namespace

TEST_CASE("the table's defaults are those of a fresh recipe")
{
    for (const std::string& key : option_keys(kQuery)) {
        const Option& option = *find_option(kQuery, key);
        INFO(key);
        if (*option.default_value)
            CHECK(at_default(option, Recipe()));
    }
}

TEST_CASE("what commands take has help, and a job can say it")
{
    for (const Option& option : option_table()) {
        INFO(option.key);
        const bool typed = option.doors & kCommands;
        CHECK(typed == (*option.help != '\0'));
        CHECK(typed == (*option.argument != '\0'));
        CHECK((option.type == OptionType::choice) == !option.values.empty());
        if (typed)
            CHECK(find_option(kJob, job_key(option)));
    }
}

TEST_CASE("a seed is any whole number of 64 bits, at every door")
{
    const Option& seed = *find_option(kQuery, "seed");
    CHECK(value_text(seed, "18446744073709551615") == "18446744073709551615");
    CHECK(value_text(seed, "007") == "7");
    for (const char* wrong : { "18446744073709551616", "-1", "+1", "1.0", " 1", "1 ", "", "0x1" })
        CHECK(value_text(seed, wrong) ==
              std::string("seed '") + wrong + "' is not a whole number from 0 to 18446744073709551615");
    Recipe recipe;
    REQUIRE(set_by_text(recipe, "seed", "18446744073709551615"));
    CHECK(recipe.seed == UINT64_MAX);
    const auto read = recipe_from_json(R"({"format": "srisp-recipe-1", "seed": 18446744073709551615})", "j", true);
    REQUIRE(read);
    CHECK(read->seed == UINT64_MAX);
}

TEST_CASE("a program's options are set by name")
{
    Options options;
    CHECK(set_option(options, "model", "spatial"));
    CHECK(set_option(options, "input", "linear"));
    CHECK(set_option(options, "precision", "fast"));
    CHECK(set_option(options, "seed", "3"));
    const ScratchFolder folder;
    CHECK(set_option(options, "params", folder.file("p.json", to_json(Parameters()))));
    CHECK(options.model == "spatial");
    CHECK(options.input == InputEncoding::linear);
    CHECK(options.precision == Precision::fast);
    CHECK(options.seed == 3);
    CHECK(options.parameters.has_value());
    CHECK(set_option(options, "input", "sgrb").error().message == "unknown input 'sgrb'; did you mean 'srgb'?");
    CHECK(set_option(options, "input", "camera").error().message ==
          "unknown input 'camera'; known: auto, srgb, linear");
    CHECK(set_option(options, "sed", "3").error().message == "unknown option 'sed'; did you mean 'seed'?");
    CHECK(set_option(options, "hold", "1").error().message ==
          "unknown option 'hold'; known: model, params, input, gainmap, precision, brightness, seed, mosaic, levels, "
          "noise, "
          "profile, noise_seed, develop, whitebalance, exposure, highlights, allow_partial, resize, crop, isolate");
    CHECK(set_option(options, "params", "/nowhere/p.json").error().message ==
          "parameters '/nowhere/p.json': No such file or directory");
    CHECK(options.input == InputEncoding::linear);
}
