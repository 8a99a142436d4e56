// SPDX-License-Identifier: Apache-2.0
#include "train/run/training_recipe.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "base/input_file.h"
#include "base/installed_files.h"
#include "base/json_object.h"
#include "base/near_names.h"
#include "base/shown_text.h"
#include "model/model_data.h"
#include "model/safetensors.h"

namespace srisp::train {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;
const char kExtension[] = ".json", kFolder[] = "train";

/// Settings that do not change what is learnt.
const std::set<std::string> kFree = { "description",        "pack",      "output",   "licence",
                                      "checkpoint_minutes", "log_every", "precision" };

std::string name_of(const std::string& path)
{
    return fs::path(path).stem().string();
}

/// A name with a '/' or an extension is a path, relative to `user`, the recipe that builds on it, if any. Others are
/// looked for beside that recipe, too, and among the installed ones.
Expected<std::string> find_recipe(const std::string& name, const std::string& user)
{
    const fs::path folder = fs::path(user).parent_path();
    if (name.find('/') != std::string::npos || fs::path(name).extension() == kExtension)
        return (folder / name).string();
    std::error_code error;
    for (const fs::path& place : { folder, shared_folder(kFolder) }) {
        const fs::path path = place / (name + kExtension);
        // A recipe of one's own may have the name of the installed one that it builds on.
        if (!place.empty() && fs::exists(path, error) &&
            !(fs::exists(user, error) && fs::equivalent(path, user, error)))
            return path.string();
    }
    return Error{ "unknown recipe '" + shown_text(name) + "'" + near_names(name, recipe_names()) };
}

Status apply(TrainingRecipe& recipe, const json& object, const std::string& where)
{
    SettingsReader reader(object, where);
    recipe.describe(reader);
    return reader.finish();
}

/// Reads a recipe's file into `recipe`, after those that it builds on. `users`: the files that led to it.
Status read_into(TrainingRecipe& recipe, const std::string& path, std::vector<std::string>& users)
{
    const std::string where = "recipe '" + path + "'";
    std::error_code error; // what cannot be looked up cannot be read either, and that is told below
    const std::string own = fs::weakly_canonical(path, error).string();
    if (std::find(users.begin(), users.end(), own) != users.end())
        return Error{ where + ": builds on itself" };
    users.push_back(own);
    const Expected<std::string> text = read_file(path, kMaxBytes, where);
    if (!text)
        return text.error();
    Expected<json> object = parse_json_object(*text, where, "file");
    if (!object)
        return object.error();
    if (const auto base = object->find("base"); base != object->end()) {
        const std::string name = base->is_string() ? base->get<std::string>() : std::string();
        if (name.empty() || shown_text(name, name.size()) != name)
            return Error{ where + ": 'base' must be the name or path of a recipe, has " + shown_json(*base) };
        const Expected<std::string> file = find_recipe(name, path);
        if (!file)
            return Error{ where + ": 'base': " + file.error().message };
        object->erase(base);
        if (Status status = read_into(recipe, *file, users); !status)
            return status;
    }
    return apply(recipe, *object, where);
}

/// Of those that a model's format knows; the smaller of two.
int nearest_selection_size(int size)
{
    return *std::min_element(std::begin(kSelectionSizes), std::end(kSelectionSizes),
                             [size](int a, int b) { return std::abs(a - size) < std::abs(b - size); });
}

/// Combinations that no single setting forbids.
Status check(const TrainingRecipe& recipe, const std::string& where)
{
    const auto wrong = [&where](const std::string& what) { return Error{ where + ": " + what }; };
    if (recipe.model.anchor && !recipe.model.statistics && recipe.model.method == "srisp")
        return wrong("'model.anchor' needs 'model.statistics'");
    if (recipe.trainer.loss.reverse + recipe.trainer.loss.forward + recipe.trainer.loss.linear == 0)
        return wrong("'loss.reverse', 'loss.forward' and 'loss.linear' are all 0: nothing to learn from");
    if (recipe.data.image_size < 32)
        return wrong("'data.image_size' must be at least 32: encoders halve an image five times, has " +
                     std::to_string(recipe.data.image_size));
    return {};
}

} // namespace

Expected<LoadedRecipe> load_recipe(const std::string& name_or_path, const std::vector<std::string>& assignments)
{
    const Expected<std::string> path = find_recipe(name_or_path, "");
    if (!path)
        return path.error();
    LoadedRecipe loaded{ {}, name_of(*path), {} };
    if (Status status = read_into(loaded.recipe, *path, loaded.files); !status)
        return status.error();
    for (const std::string& assignment : assignments) {
        const Expected<json> object = parse_assignment(assignment);
        if (!object)
            return object.error();
        if (Status status = apply(loaded.recipe, *object, "--set " + assignment); !status)
            return status.error();
    }
    if (Status status = check(loaded.recipe, "recipe '" + *path + "'"); !status)
        return status.error();
    loaded.recipe.model.selection_size = nearest_selection_size(loaded.recipe.data.image_size);
    return loaded;
}

static nlohmann::ordered_json recipe_object(const TrainingRecipe& recipe)
{
    TrainingRecipe copy = recipe; // a visitor could change it
    SettingsWriter writer;
    copy.describe(writer);
    return writer.object();
}

std::string recipe_text(const TrainingRecipe& recipe)
{
    return recipe_object(recipe).dump(2) + "\n";
}

std::vector<SettingRow> recipe_rows(const TrainingRecipe& recipe)
{
    TrainingRecipe copy = recipe;
    SettingsLister lister;
    copy.describe(lister);
    return lister.rows();
}

static json flat_recipe(const TrainingRecipe& recipe)
{
    return flat_settings(json(recipe_object(recipe)));
}

std::string recipe_difference(const std::string& there, const TrainingRecipe& here)
{
    const Expected<json> object = parse_json_object(there, "its recipe", "text");
    TrainingRecipe other;
    if (!object)
        return object.error().message;
    // Settings that this program has learnt since then have their defaults there.
    if (Status status = apply(other, *object, "its recipe"); !status)
        return status.error().message;
    const json old_values = flat_recipe(other);
    const json new_values = flat_recipe(here);
    std::string text;
    for (const auto& [key, value] : new_values.items())
        if (kFree.count(key) == 0 && old_values[key] != value)
            text += (text.empty() ? "" : "; ") + key + " is " + shown_json(old_values[key]) + " there, " +
                    shown_json(value) + " here";
    return text;
}

std::vector<std::string> recipe_names()
{
    std::set<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(shared_folder(kFolder), error))
        if (entry.path().extension() == kExtension)
            names.insert(name_of(entry.path()));
    return { names.begin(), names.end() };
}

} // namespace srisp::train
