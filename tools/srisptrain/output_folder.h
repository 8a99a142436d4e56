// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "train/learning/checkpoint.h"
#include "train/run/training_recipe.h"

namespace srisp::tool {

/// The folder of a training: made where it is missing, and no other process trains into it meanwhile.
class OutputFolder {
public:
    /// Fails where it cannot be made, or is in use.
    explicit OutputFolder(const std::string& path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    std::string file(const std::string& name) const { return m_path + "/" + name; }
    /// Removes what an earlier training left.
    void clear();
    /// Removes a file where it is there.
    void remove(const std::string& name);

private:
    std::string m_path;
    int m_lock;
};

/// Fails where the training would write onto a file that it reads: a recipe (but one that it would write again as it
/// is), the model that it starts from, or a file of the pack.
void refuse_inputs_as_outputs(const train::LoadedRecipe& loaded);

/// What checkpoints keep of a training's origin.
std::map<std::string, std::string> origin_of(const train::TrainingRecipe& recipe, const std::string& pack_hash);

/// The checkpoint to go on from: none where the file is not there. Fails where it belongs to another recipe or pack,
/// and says in what they differ.
std::optional<train::TrainingState> find_checkpoint(const std::string& path, const train::TrainingRecipe& recipe,
                                                    const std::string& pack_hash);

} // namespace srisp::tool
