// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "options.h"
#include "pack/training_pack.h"
#include "train/run/training_recipe.h"

namespace srisp::tool {

/// Everything that a training needs, as command line and recipe say.
struct Session {
    train::LoadedRecipe recipe;
    torch::Device device = torch::kCPU;
    std::unique_ptr<train::ProcessGroup> group;
    std::shared_ptr<const TrainingPack> pack;
    std::shared_ptr<train::Samples> samples;
    std::shared_ptr<train::Unprocessor> model;
    std::shared_ptr<const train::EvaluationSet> tests; ///< on rank 0; null where the pack has nothing to test on
    std::string tests_missing;                         ///< why there are none

    /// The model itself has nothing to learn: only tested.
    bool learns() const { return !model->parameters().empty(); }
    /// Another model of the kind that learns; its parameters do not matter.
    std::shared_ptr<train::Unprocessor> another() const;
    const train::TrainingRecipe& settings() const { return recipe.recipe; }
};

/// The recipe that the command line asks for, with what it changes.
train::LoadedRecipe recipe_of(const TrainOptions& options);

/// Opens everything; fails with a message about what is wrong.
Session open_session(const TrainOptions& options);

} // namespace srisp::tool
