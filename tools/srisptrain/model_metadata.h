// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "pack/training_pack.h"
#include "recipe.h"

namespace srisp::tool {

/// What a model file says of how it came about: train_data and license (open images only: the recipe's; else that it
/// may not be given away), train_commit, date.
std::map<std::string, std::string> model_metadata(const train::Recipe& recipe, const TrainingPack& pack);

} // namespace srisp::tool
