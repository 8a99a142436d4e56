// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "train/tensors/torch_api.h"
#include <srisp/expected.h>

namespace srisp::train {

/// All that a training needs to go on as if it had never stopped. Random numbers count from the step, so need no state.
struct TrainingState {
    std::map<std::string, torch::Tensor> tensors; ///< float32 vectors: weights, averages, moments of the optimiser
    std::map<std::string, double> numbers;        ///< step, best score, seconds, …
    std::string layout;                           ///< ParameterVector::layout
    std::map<std::string, std::string> texts;     ///< what it was trained by: recipe, pack
};

/// Writes a state, whole or not at all: a safetensors file (format "srisp-checkpoint-1"). Errors: the disk's own.
Status save_checkpoint(const TrainingState& state, const std::string& path);

/// Reads a state back, to the bit. Errors: no checkpoint, another version, truncated.
Expected<TrainingState> load_checkpoint(const std::string& path);

} // namespace srisp::train
