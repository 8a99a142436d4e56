// SPDX-License-Identifier: Apache-2.0
#include "recipe/brightness.h"

#include <doctest/doctest.h>

#include "recipe/recipe.h"

using namespace srisp;

namespace {

std::string error_of(const std::string& text)
{
    const auto brightness = parse_brightness(text);
    return brightness ? "" : brightness.error().message;
}

std::string recipe_with(const std::string& entry)
{
    return R"({ "format": "srisp-recipe-1", "source": "a.jpg", "reference": "r.dng", )" + entry + " }";
}

} // namespace

TEST_CASE("a brightness is a number of EV with or without a sign, or a sample")
{
    CHECK(parse_brightness("+0.5")->ev == 0.5);
    CHECK(parse_brightness("0.5")->ev == 0.5);
    CHECK(parse_brightness("-1")->ev == -1);
    CHECK(parse_brightness("0")->ev == 0);
    CHECK(parse_brightness("20")->ev == 20);
    CHECK(parse_brightness("-2e1")->ev == -20);
    CHECK(!parse_brightness("0")->sample);
    CHECK(parse_brightness("sample")->sample);
}

TEST_CASE("other brightnesses are refused with what they may be")
{
    for (const char* text : { "", "+", "-", "+-1", "++1", "bright", "Sample", "0.5EV", "1,5", " 1", "1 ", "nan", "inf",
                              "20.01", "-21", "1e300", "1e999" }) {
        INFO(text);
        CHECK(error_of(text) ==
              "brightness '" + std::string(text) + "' is neither a number of EV from -20 to 20 nor 'sample'");
    }
}

TEST_CASE("recipes give a brightness as a number or a text, queries and programs as a text")
{
    for (const char* value : { "0.5", "\"+0.5\"" }) {
        const auto recipe = recipe_from_json(recipe_with(std::string("\"brightness\": ") + value), "/p.srisp", false);
        REQUIRE_MESSAGE(recipe, (recipe ? "" : recipe.error().message));
        CHECK(recipe->brightness.value().ev == 0.5);
    }
    const auto sampled = recipe_from_json(recipe_with("\"brightness\": \"sample\""), "/p.srisp", false);
    REQUIRE(sampled);
    CHECK(sampled->brightness.value().sample);
    const auto wrong = recipe_from_json(recipe_with("\"brightness\": [1]"), "/p.srisp", false);
    REQUIRE(!wrong);
    CHECK(wrong.error().message == "recipe '/p.srisp': 'brightness': must be a number of EV or \"sample\"");
    const auto large = recipe_from_json(recipe_with("\"brightness\": 21"), "/p.srisp", false);
    REQUIRE(!large);
    CHECK(large.error().message.find("'21' is neither a number of EV from -20 to 20") != std::string::npos);

    Recipe recipe;
    REQUIRE(set_by_text(recipe, "brightness", "-1.5"));
    CHECK(recipe.brightness.value().ev == -1.5);
    Options options;
    REQUIRE(set_option(options, "brightness", "sample"));
    CHECK(options.brightness.value().sample);
    CHECK(!set_option(options, "brightness", "dark"));
}

TEST_CASE("a brightness is for photos that become RAW-like images")
{
    Recipe recipe;
    recipe.references = { "r.dng" };
    recipe.brightness = Brightness{ 1, false };
    CHECK(check_complete(recipe, "x"));
    recipe.action = Recipe::Action::print;
    CHECK(check_complete(recipe, "x"));
    recipe.action = Recipe::Action::read;
    CHECK(check_complete(recipe, "x").error().message == "x: brightness is for photos that become RAW-like images");
    recipe.action = Recipe::Action::apply;
    recipe.direction = Direction::forward;
    CHECK(check_complete(recipe, "x").error().message == "x: brightness is for photos that become RAW-like images");
}
