// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "train/anchor/anchor_fit.h"
#include "train/evaluation/evaluation.h"
#include "train/learning/trainer.h"
#include "train/network/model_settings.h"
#include "train/run/training_run.h"
#include "train/samples/data_settings.h"
#include "train/settings/settings.h"

namespace srisp::train {

/// Everything that decides what a training gives: one JSON file. Recipes build on others: {"base": "default", …} takes
/// that one's settings and changes what it names itself.
struct TrainingRecipe {
    std::string description, pack = "pack", output, init;
    std::string licence = "Apache-2.0";
    std::string precision = "F32";
    int seed = 1;
    ModelSettings model;
    AnchorFitSettings anchor_fit;
    DataSettings data;
    TrainerSettings trainer;
    RunSettings run;
    ValidationSettings validation;

    template<class Visitor> void describe(Visitor& v)
    {
        v.path("description", description, "for people: what this recipe is for");
        v.path("pack", pack, "folder of the training pack, as srisppack makes it");
        v.path("output", output, "folder for model, checkpoint and log; empty: the recipe's name");
        v.path("init", init, "model to start from, a name or a path; empty: from random numbers");
        v.path("licence", licence, "of the model, if all images that it learns from are open");
        v.choice("precision", precision, { "F32", "F16" }, "numbers in the model file; F16 halves it");
        v.integer("seed", seed, 0, 1'000'000'000, "of all random choices");
        v.group("model", model);
        v.group("anchor_fit", anchor_fit);
        v.group("data", data);
        trainer.describe(v);
        run.describe(v);
        v.group("validation", validation);
    }
};

/// A recipe and the file that it came from.
struct LoadedRecipe {
    TrainingRecipe recipe;
    std::string name;               ///< of the file, without its extension
    std::vector<std::string> files; ///< that one, and those that it builds on
};

/// Reads the recipe with this name or path (names are those of `share/srisp/train`), those that it builds on first,
/// then the `assignments` ("loss.clip_norm=2"). Errors: no such recipe, broken JSON, recipes that build on themselves,
/// unknown settings, impossible values.
Expected<LoadedRecipe> load_recipe(const std::string& name_or_path, const std::vector<std::string>& assignments);

/// The recipe as JSON with all its settings, indented.
std::string recipe_text(const TrainingRecipe& recipe);

/// All settings with their values.
std::vector<SettingRow> recipe_rows(const TrainingRecipe& recipe);

/// Names the settings in which a checkpoint's recipe (JSON) differs from this one, as in "optimizer.rate is 0.001
/// there, 0.002 here; …"; "" where a training can go on. Where files lie and how often they are written may differ.
std::string recipe_difference(const std::string& there, const TrainingRecipe& here);

/// Names of the installed recipes, sorted.
std::vector<std::string> recipe_names();

} // namespace srisp::train
