// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/expected.h>

namespace srisp {

/// The file that a model's name or path means [Model::load]; the error lists the near names and the folders.
Expected<std::string> find_model_file(const std::string& name_or_path);

/// For messages, "looked in a, b": where models lie that are known by name, the folders of SRISP_MODEL_PATH, then the
/// installed one.
std::string model_folder_list();

/// The files of that name in these folders, first the one that the name means. A text that is no mere name (with a '/',
/// an extension, control characters) has none.
std::vector<std::string> model_files_named(const std::string& name);

/// Names of the models in all folders, sorted, each once.
std::vector<std::string> model_names();

/// "models/default.safetensors" → "default".
std::string model_name_of_path(const std::string& path);

} // namespace srisp
