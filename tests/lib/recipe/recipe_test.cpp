// SPDX-License-Identifier: Apache-2.0
#include "recipe/recipe.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "recipe/option_table.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

Recipe good(const std::string& text, bool is_job = false)
{
    auto recipe = recipe_from_json(text, "/shots/a.srisp", is_job);
    REQUIRE_MESSAGE(bool(recipe), recipe.error().message);
    return *recipe;
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Parameters as JSON, with this gain.
std::string parameters_text(float gain)
{
    Parameters parameters;
    parameters.gain = gain;
    return to_json(parameters, -1);
}

std::string refused(const std::string& text, bool is_job = false)
{
    const auto recipe = recipe_from_json(text, "/shots/a.srisp", is_job);
    REQUIRE(!recipe);
    return recipe.error().message;
}

} // namespace

TEST_CASE("paths in a recipe are relative to its folder")
{
    const Recipe recipe = good(R"({"format": "srisp-recipe-1", "source": "p.jpg", "reference": "a.dng;/b.dng;c/*.dng",
                                   "model": "m.safetensors", "seed": 5, "hold": true})");
    CHECK(recipe.source == "/shots/p.jpg");
    CHECK(recipe.references == std::vector<std::string>{ "/shots/a.dng", "/b.dng", "/shots/c/*.dng" });
    CHECK(recipe.model == "/shots/m.safetensors");
    CHECK(recipe.seed == 5);
    CHECK(recipe.hold);
    CHECK(
        good(R"({"format": "srisp-recipe-1", "source": "/p.jpg", "reference": ["a.dng", "b.dng"], "model": "default"})")
            .references == std::vector<std::string>{ "/shots/a.dng", "/shots/b.dng" });
}

TEST_CASE("references with odd names stand in a recipe, alone and in lists")
{
    const ScratchFolder folder;
    std::vector<std::string> all;
    for (const char* name : { "a;b.dng", "x*.dng", "y[1].dng" })
        all.push_back(folder.file(name));
    const auto references = [&](const std::string& json) {
        const auto recipe =
            recipe_from_json(R"({"format": "srisp-recipe-1", "source": "p.jpg", "reference": )" + json + "}",
                             folder.path("r.srisp"), false);
        REQUIRE_MESSAGE(recipe, recipe.error().message);
        return recipe->references;
    };
    CHECK(references("\"a;b.dng\"") == std::vector<std::string>{ all[0] });
    CHECK(references("\"a;b.dng;x*.dng;y[1].dng\"") == all);
    CHECK(references(R"(["a;b.dng", "x*.dng", "y[1].dng"])") == all);
    CHECK(references(R"(["c;d.dng"])") == std::vector<std::string>{ folder.path("c;d.dng") });
}

TEST_CASE("parameters stand in a recipe or in a file beside it")
{
    const Recipe inside =
        good(R"({"format": "srisp-recipe-1", "source": "p.jpg", "parameters": )" + parameters_text(3) + "}");
    REQUIRE(inside.parameters);
    CHECK(inside.parameters->gain == 3);
    const ScratchFolder folder;
    folder.file("p.json", "{\"image\": \"p.jpg\", " + parameters_text(2).substr(1));
    const std::string beside = R"({"format": "srisp-recipe-1", "source": "p.jpg", "parameters": "p.json"})";
    const auto recipe = recipe_from_json(beside, folder.path("a.srisp"), false);
    REQUIRE_MESSAGE(recipe, recipe.error().message);
    REQUIRE(recipe->parameters);
    CHECK(recipe->parameters->gain == 2);
    folder.file("p.json", "{}");
    CHECK(recipe_from_json(beside, folder.path("a.srisp"), false).error().message ==
          "recipe '" + folder.path("a.srisp") + "': 'parameters': parameters in '" + folder.path("p.json") +
              "' has no 'format'");
}

TEST_CASE("jobs have actions, recipes have sources")
{
    const Recipe job = good(R"({"format": "srisp-recipe-1", "action": "save", "file": "p.json"})", true);
    CHECK(job.action == Recipe::Action::save);
    CHECK(job.file == "p.json");
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "source": "p.jpg", "action": "print"})"),
              "'action': a recipe can apply, read, sensor or develop"));
    CHECK(good(R"({"format": "srisp-recipe-1", "source": "p.jpg", "action": "read"})").action == Recipe::Action::read);
    CHECK(good(R"({"format": "srisp-recipe-1", "source": "p.#.jpg", "action": "read"})", true).source ==
          "/shots/p.#.jpg");
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "action": "prnt"})", true), "did you mean 'print'?"));
}

TEST_CASE("a recipe says what to develop into, and how")
{
    const auto with = [](const std::string& entries) {
        return R"({"format": "srisp-recipe-1", "source": "p.jpg", "reference": "r.dng", )" + entries + "}";
    };
    const Recipe recipe =
        good(with(R"("develop": "lin_ap1_scene", "whitebalance": 5600, "exposure": -0.5, "highlights": "blend")"));
    CHECK(recipe.develop == "lin_ap1_scene");
    CHECK(recipe.white_balance.temperature == 5600);
    CHECK(recipe.exposure == -0.5);
    CHECK(recipe.highlights == Highlights::blend);
    CHECK(good(with(R"("whitebalance": "2,1,1.5")")).white_balance.multipliers[2] == 1.5f);
    CHECK(has(refused(with(R"("develop": "sRGB")")), "'develop': unknown scene-linear colour space 'sRGB'"));
    CHECK(has(refused(with(R"("develop": 1)")), "'develop': must be a string"));
    CHECK(has(refused(with(R"("whitebalance": [1, 1, 1])")), "'whitebalance': must be a temperature or a string"));
    CHECK(has(refused(with(R"("exposure": true)")), "'exposure': must be a number of EV"));
    CHECK(has(refused(with(R"("exposure": 21)")), "'exposure': exposure '21' is no number of EV"));
}

TEST_CASE("what is developed is RAW-like, and names a space")
{
    Recipe recipe;
    recipe.source = "raw.exr";
    recipe.develop = "ACEScg";
    take_as_development(recipe);
    CHECK(recipe.action == Recipe::Action::develop);
    CHECK(check_complete(recipe, "x"));
    recipe.develop.clear();
    CHECK(check_complete(recipe, "x").error().message == "x: names no colour space to develop into");
    recipe.develop = "ACEScg";
    recipe.mosaic = Mosaic::rggb;
    CHECK(check_complete(recipe, "x").error().message == "x: a mosaic is not developed");
    recipe.mosaic.reset();
    recipe.action = Recipe::Action::apply;
    recipe.references = { "r.dng" };
    take_as_development(recipe);
    CHECK(recipe.action == Recipe::Action::apply);
    recipe.direction = Direction::forward;
    CHECK(check_complete(recipe, "x").error().message == "x: RAW-like images are developed, not processed ones");
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
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "source": 3})"), "'source': must be a string"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "seed": -3})"), "'seed': must be a whole number from 0"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "seed": 18446744073709551616})"),
              "'seed': must be a whole number from 0 to 18446744073709551615"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "formt": "a"})"), "unknown key 'formt'; did you mean 'format'?"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "lazy": true})"), "unknown key 'lazy'"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "hold": 1})"), "'hold': must be true or false"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "reference": [1]})"), "'reference': must be a path or a list"));
    CHECK(
        has(refused(R"({"format": "srisp-recipe-1", "parameters": 1})"), "'parameters': must be an object or a path"));
    CHECK(has(refused(R"({"format": "srisp-recipe-1", "direction": "fwd"})"), "unknown direction 'fwd'"));
}

TEST_CASE("a recipe that a stranger has nested, swollen or doubled is refused in a short message")
{
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    const std::string start = R"({"format": "srisp-recipe-1", "source": "p.jpg", )";
    for (const char* key : { "parameters", "reference", "model", "no_such_key" })
        CHECK(refused(start + "\"" + key + "\":" + deep + "}") ==
              "recipe '/shots/a.srisp': is nested more than 32 levels deep");
    CHECK(has(refused(start + R"("source": "q.jpg"})"), "has 'source' twice in one object"));
    CHECK(has(refused(start + "\"model\":\"" + std::string(2000000, 'x') + "\"}"), "limit 1048576"));
    CHECK(refused(start + "\"" + std::string(100000, 'x') + "\":1}").size() < 1000);
    CHECK(refused(start + "\"input\":\"" + std::string(100000, 'x') + "\"}").size() < 1000);
    CHECK(has(refused(start + "\"parameters\":{\"gain\":" + deep + "}}"), "nested"));
}

TEST_CASE("no URL, endless text or hidden end is taken for a path, wherever a recipe holds one")
{
    for (const std::string key : { "source", "model", "reference", "parameters" }) {
        const auto told = [&](const std::string& value) {
            return refused(R"({"format": "srisp-recipe-1", ")" + key + "\": \"" + value + "\"}");
        };
        CHECK(told("http://127.0.0.1:9/a.mp4") ==
              "recipe '/shots/a.srisp': '" + key + "': 'http://127.0.0.1:9/a.mp4' is a URL; only files are read");
        CHECK(has(told("a/" + std::string(5000, 'x')), "': has a path of 5002 bytes, limit 4095"));
        CHECK(has(told("a/b.safetensors\\u0000.jpg"), "is no path: it holds a zero byte"));
    }
    Recipe recipe;
    for (const char* key : { "reference", "model", "params" })
        CHECK(has(set_by_text(recipe, key, "https://127.0.0.1:9/x").error().message, "is a URL; only files are read"));
}
