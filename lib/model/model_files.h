// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/expected.h>

namespace srisp {

/// The file that a model's name or path means [Model::load]; the error lists the near names and the folders.
Expected<std::string> find_model_file(const std::string& name_or_path);

/// Names of the models in all folders, sorted, each once.
std::vector<std::string> model_names();

/// "models/default.safetensors" → "default".
std::string model_name_of_path(const std::string& path);

} // namespace srisp
