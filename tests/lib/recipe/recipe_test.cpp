// SPDX-License-Identifier: Apache-2.0
#include "recipe/recipe.h"

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

Recipe good(const std::string& text, bool is_job = false)
{
    auto recipe = recipe_from_json(text, "/shots/a.srisp", is_job);
    REQUIRE_MESSAGE(bool(recipe), recipe.error().message);
    return *recipe;
}

std::string refused(const std::string& text, bool is_job = false)
{
    const auto recipe = recipe_from_json(text, "/shots/a.srisp", is_job);
    REQUIRE(!recipe);
    return recipe.error().message;
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("paths in a recipe are relative to its folder")
{
    const Recipe recipe = good(R"({"format": "srisp-recipe-1", "source": "p.jpg", "reference": "a.dng;/b.dng;c/*.dng",
                                   "model": "m.safetensors", "seed": 5, "hold": true})");
    CHECK(recipe.source == "/shots/p.jpg");
    CHECK(recipe.reference == "/shots/a.dng;/b.dng;/shots/c/*.dng");
    CHECK(recipe.model == "/shots/m.safetensors");
    CHECK(recipe.seed == 5);
    CHECK(recipe.hold);
    CHECK(
        good(R"({"format": "srisp-recipe-1", "source": "/p.jpg", "reference": ["a.dng", "b.dng"], "model": "default"})")
            .reference == "/shots/a.dng;/shots/b.dng");
}

TEST_CASE("parameters stand in a recipe or in a file beside it")
{
    CHECK(good(R"({"format": "srisp-recipe-1", "source": "p.jpg", "parameters": {"gain": 1}})").parameters ==
          "{\"gain\":1}");
    const ScratchFolder folder;
    folder.file("p.json", "{\"gain\": 2}");
    const auto recipe = recipe_from_json(R"({"format": "srisp-recipe-1", "source": "p.jpg", "parameters": "p.json"})",
                                         folder.path("a.srisp"), false);
    REQUIRE(bool(recipe));
    CHECK(recipe->parameters == "{\"gain\": 2}");
    CHECK(recipe->parameters_where == "parameters '" + folder.path("p.json") + "'");
}

TEST_CASE("jobs have actions, recipes have sources")
{
    const Recipe job = good(R"({"format": "srisp-recipe-1", "action": "save", "file": "p.json"})", true);
    CHECK(job.action == Recipe::Action::save);
    CHECK(job.file == "p.json");
    CHECK(
        has(refused(R"({"format": "srisp-recipe-1", "source": "p.jpg", "action": "print"})"), "unknown key 'action'"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "source": "p.jpg"})", true), "unknown key 'source'"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "action": "prnt"})", true), "did you mean 'print'?"));
}

TEST_CASE("a wrong recipe says what is wrong, and where")
{
    CHECK(refused("not json") == "recipe '/shots/a.srisp': is not a JSON object");
    CHECK(refused("[1]") == "recipe '/shots/a.srisp': is not a JSON object");
    CHECK(has(refused(R"({"source": "p.jpg"})"), "has no 'format'"));
    CHECK(has(refused(R"({"format": "srisp-recipe-2", "source": "p.jpg"})"), "'srisp-recipe-2' is not srisp-recipe-1"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1"})"), "has no 'source'"));
    CHECK(refused(R"({"format": "srisp-recipe-1", "refrence": "a"})") ==
          "recipe '/shots/a.srisp': unknown key 'refrence'; did you mean 'reference'?");
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "source": 3})"), "'source': must be a text"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "seed": -3})"), "'seed': must be a whole number from 0"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "hold": 1})"), "'hold': must be true or false"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "reference": [1]})"), "'reference': must be a path or a list"));
    CHECK(
        has(refused(R"({"format": "srisp-recipe-1", "parameters": 1})"), "'parameters': must be an object or a path"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "direction": "fwd"})"), "unknown direction 'fwd'"));
}
