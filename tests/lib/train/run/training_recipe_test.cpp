// SPDX-License-Identifier: Apache-2.0
#include "train/run/training_recipe.h"

#include <filesystem>
#include <random>

#include <doctest/doctest.h>

#include "base/shown_text.h"
#include "fuzz/damage.h"
#include "lib/train/toy_training.h"
#include "scratch_folder.h"
#include "train/run/model_file.h"

using namespace srisp;
using namespace srisp::train;

namespace {

std::string error_of(const std::string& path, const std::vector<std::string>& assignments = {})
{
    const Expected<LoadedRecipe> loaded = load_recipe(path, assignments);
    return loaded ? "" : loaded.error().message;
}

} // namespace

TEST_CASE("a recipe takes the settings of the one that it builds on, and changes its own")
{
    const ScratchFolder scratch;
    scratch.file("first.json", R"({"seed":3,"optimizer":{"rate":0.01,"clip_norm":2},"steps":50})");
    scratch.file("second.json", R"({"base":"first.json","optimizer":{"rate":0.02}})");
    const std::string third = scratch.file("third.json", R"({"base":"second","steps":70})");
    const Expected<LoadedRecipe> loaded = load_recipe(third, { "steps=80", "data.isp.gamma=2.5,3" });
    REQUIRE_MESSAGE(loaded, loaded.error().message);
    CHECK(loaded->name == "third");
    CHECK(loaded->recipe.seed == 3);
    CHECK(loaded->recipe.trainer.optimizer.rate == 0.02);
    CHECK(loaded->recipe.trainer.optimizer.clip_norm == 2);
    CHECK(loaded->recipe.trainer.steps == 80);
    CHECK(loaded->recipe.data.isp.lowest_gamma == 2.5);
}

TEST_CASE("a recipe of one's own may have the name of the installed one that it builds on")
{
    const ScratchFolder scratch;
    const std::string own = scratch.file("default.json", R"({"base":"default","seed":77})");
    const Expected<LoadedRecipe> loaded = load_recipe(own, {}), installed = load_recipe("default", {});
    REQUIRE_MESSAGE(loaded, loaded.error().message);
    CHECK(loaded->recipe.seed == 77);
    CHECK(loaded->recipe.trainer.steps == installed->recipe.trainer.steps);
}

TEST_CASE("broken recipes are refused, each with its own message")
{
    const ScratchFolder scratch;
    const auto refused = [&](const std::string& text) {
        const std::string path = scratch.file("r.json", text), message = error_of(path);
        const std::string begin = "recipe '" + path + "': ";
        return message.compare(0, begin.size(), begin) == 0 ? message.substr(begin.size()) : "not about it: " + message;
    };
    CHECK(refused("{\n \"steps\": 3,\n}") == "file is not a JSON object (line 3, column 1)");
    CHECK(refused("[]") == "file is not a JSON object");
    CHECK(refused(R"({"steps":3,"steps":4})") == "'steps' appears twice in the file");
    CHECK(refused(R"({"steps":0})") == "'steps' must be a whole number from 1 to 100000000, has 0");
    CHECK(
        refused(R"({"optimizer":{"rat":1}})").find("unknown setting 'optimizer.rat'; did you mean 'optimizer.rate'") ==
        0);
    CHECK(refused(R"({"base":3})") == "'base' must be the name or path of a recipe, has 3");
    CHECK(refused(R"({"base":"defualt"})") == "'base': unknown recipe 'defualt'; did you mean 'default'?");
    CHECK(refused(R"({"model":{"statistics":false}})") == "'model.anchor' needs 'model.statistics'");
    CHECK(refused(R"({"data":{"image_size":16}})") ==
          "'data.image_size' must be at least 32: encoders halve an image five times, has 16");
    CHECK(refused(R"({"loss":{"reverse":0,"forward":0}})").find("nothing to learn from") != std::string::npos);
    scratch.file("a.json", R"({"base":"b.json"})");
    CHECK(error_of(scratch.file("b.json", R"({"base":"a.json"})")).find("b.json': builds on itself") !=
          std::string::npos);
    // Names that the file system refuses, or that end earlier than they seem to.
    const std::string long_name = "./" + std::string(300, 'a') + ".json";
    CHECK(error_of(scratch.file("user.json", "{\"base\":\"" + long_name + "\"}")).find("cannot open") !=
          std::string::npos);
    std::filesystem::create_symlink("loop.json", scratch.path("loop.json"));
    CHECK(error_of(scratch.path("loop.json")).find("recipe '" + scratch.path("loop.json") + "': cannot open") == 0);
    CHECK(refused(R"({"base":"a.json\u0000"})") ==
          "'base' must be the name or path of a recipe, has \"a.json\\u0000\"");
    scratch.file("broken.json", R"({"sead":1})");
    CHECK(error_of(scratch.file("user.json", R"({"base":"broken.json"})")) ==
          "recipe '" + scratch.path("broken.json") + "': unknown setting 'sead'; did you mean 'seed'?");
}

TEST_CASE("unknown recipes and assignments list what is near")
{
    CHECK(error_of("defalt") == "unknown recipe 'defalt'; did you mean 'default'?");
    CHECK(error_of("default", { "stepss=3" }) == "--set stepss=3: unknown setting 'stepss'; did you mean 'steps'?");
    CHECK(error_of("default", { "steps=many" }) ==
          "--set steps=many: 'steps' must be a whole number from 1 to 100000000, has \"many\"");
    CHECK(error_of("default", { "steps" }) == "--set steps: expected key=value");
    CHECK(error_of("/no/such.json").find("recipe '/no/such.json': cannot open") == 0);
}

TEST_CASE("every installed recipe can be read, and says what it is for")
{
    const std::vector<std::string> names = recipe_names();
    CHECK(names.size() >= 16);
    for (const std::string& name : names) {
        CAPTURE(name);
        const Expected<LoadedRecipe> loaded = load_recipe(name, {});
        REQUIRE_MESSAGE(loaded, loaded.error().message);
        CHECK(!loaded->recipe.description.empty());
    }
}

TEST_CASE("the model that ships looks at single pixels, and the paper's model and its ablations at neighbours")
{
    for (const char* name : { "default", "finetune" })
        CHECK_MESSAGE(load_recipe(name, {})->recipe.model.kernel_size == "1", std::string(name));
    for (const char* name : { "spatial", "paper", "no_dps", "merged_gain", "static_tone", "no_mt", "mt_real_reference",
                              "real_pairs", "pseudo_pairs" })
        CHECK_MESSAGE(load_recipe(name, {})->recipe.model.kernel_size == "3", std::string(name));
}

TEST_CASE("the model of every installed recipe takes a step")
{
    ProcessGroup alone;
    for (const std::string& name : recipe_names()) {
        CAPTURE(name);
        TrainingRecipe recipe = load_recipe(name, {})->recipe;
        const auto make = [&recipe] { return make_unprocessor(recipe.model, 1); };
        if (make()->parameters().empty())
            continue;
        recipe.trainer.pairs = 2;
        recipe.trainer.unpaired = std::min(recipe.trainer.unpaired, 2);
        recipe.trainer.mean_teacher.start = 0;
        Trainer trainer(recipe.trainer, make(), make, std::make_shared<ToySamples>(-1, 0.f, 32), alone, torch::kCPU);
        const StepReport report = *trainer.step();
        CHECK(report.finite);
        CHECK(report.loss > 0);
    }
}

TEST_CASE("the recipe that is written down gives the same settings")
{
    const ScratchFolder scratch;
    const Expected<LoadedRecipe> paper = load_recipe("paper", { "seed=9" });
    REQUIRE(paper);
    const Expected<LoadedRecipe> again = load_recipe(scratch.file("r.json", recipe_text(paper->recipe)), {});
    REQUIRE_MESSAGE(again, again.error().message);
    CHECK(recipe_text(again->recipe) == recipe_text(paper->recipe));
}

TEST_CASE("a damaged recipe is refused in one line, or comes back as it was read")
{
    const ScratchFolder scratch;
    const std::string whole = recipe_text(TrainingRecipe());
    std::mt19937 random(1);
    int taken = 0, refused = 0;
    for (int round = 0; round < 2000; ++round) {
        const Expected<LoadedRecipe> loaded =
            load_recipe(scratch.file("r.json", damaged(whole, "-0129.eE\"\\{}[],:\n\xff", whole.size(), random)), {});
        if (loaded) {
            ++taken;
            const std::string text = recipe_text(loaded->recipe);
            const Expected<LoadedRecipe> again = load_recipe(scratch.file("again.json", text), {});
            REQUIRE_MESSAGE(again, again.error().message);
            REQUIRE(recipe_text(again->recipe) == text);
        } else {
            ++refused;
            const std::string& message = loaded.error().message;
            REQUIRE(message.find("recipe '" + scratch.path("r.json") + "': ") == 0);
            REQUIRE(message.find('\n') == std::string::npos);
            REQUIRE(valid_utf8(message) == message);
        }
    }
    CHECK(taken > 0);
    CHECK(refused > 0);
}

TEST_CASE("the difference between two recipes is named, but not what does not matter")
{
    const ScratchFolder scratch;
    const std::string path = scratch.file("r.json", "{}");
    const TrainingRecipe here = load_recipe(path, {})->recipe;
    const auto difference = [&](const std::vector<std::string>& assignments) {
        return recipe_difference(recipe_text(load_recipe(path, assignments)->recipe), here);
    };
    CHECK(difference({}) == "");
    CHECK(difference({ "output=elsewhere", "checkpoint_minutes=9", "pack=/moved" }) == "");
    CHECK(difference({ "seed=5" }) == "seed is 5 there, 1 here");
    CHECK(difference({ "data.isp.gamma=2,3" }).find("data.isp.gamma is [2.0,3.0] there, [") == 0);
    CHECK(difference({ "seed=5", "loss.white=1" }) == "loss.white is 1.0 there, 0.0 here; seed is 5 there, 1 here");
    CHECK(recipe_difference("{\"gone\":1}", here).find("its recipe: unknown setting 'gone'") == 0);
}
